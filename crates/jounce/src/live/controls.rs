//! Controls of a design: every number of the spec, with its unit and the range of its slider.

use super::Design;
use crate::leaves::leaves;
use jounce_spec::NumericKey;
use serde::Serialize;

/// Ratio of the ends of a logarithmic slider to the value.
const LOG_RATIO: f64 = 10.0;
/// Ratio of the upper end of a linear slider to the value.
const LINEAR_RATIO: f64 = 3.0;
/// Upper end of a linear slider at zero, in units of the file.
const ZERO_SPAN: f64 = 10.0;
/// Ratio of the lower end of a linear slider to the value.
const LINEAR_LOW_RATIO: f64 = 0.02;

/// A number of the spec with its slider.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignControl {
    /// The key.
    pub key: String,
    /// Value, SI.
    pub value: f64,
    /// Value as written in a spec.
    pub shown: String,
    /// Unit in which it is shown, as in the file.
    pub unit: String,
    /// Size of this unit, SI.
    pub factor: f64,
    /// Help text.
    pub about: &'static str,
    /// Scale of the slider.
    pub scale: SliderScale,
    /// Lower end of the slider, SI.
    pub from: f64,
    /// Upper end of the slider, SI.
    pub to: f64,
    /// True for a whole number.
    pub count: bool,
    /// True where the file contains the key.
    pub written: bool,
}

/// A number that the spec lacks and may have.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OptionalKey {
    /// The key.
    pub key: String,
    /// Unit of a bare number.
    pub unit: &'static str,
    /// Help text.
    pub about: &'static str,
}

/// Scale of a slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SliderScale {
    /// Lengths, frequencies, angles and plain numbers.
    Linear,
    /// Quantities over decades.
    Log,
}

impl Design {
    /// Returns all controls: first the keys of the file in its order, then the keys with defaults.
    ///
    /// ```
    /// use jounce::{Harvester, live::Design};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let controls = Design::new(&harvester, &[])?.controls();
    /// let gap = controls.iter().find(|control| control.key == "stop.tip.gap");
    /// assert_eq!(gap.map(|gap| gap.unit.as_str()), Some("mm"));
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn controls(&self) -> Vec<DesignControl> {
        let mut keys: Vec<(String, Option<String>)> = leaves(&self.harvester().text())
            .into_iter()
            .map(|(path, text)| (path, Some(text)))
            .collect();
        for (path, _) in leaves(&self.spec().to_toml()) {
            let is_spring = path.starts_with("mass.") && path.ends_with(".stiffness");
            if !keys.iter().any(|(key, _)| *key == path) && !is_spring {
                keys.push((path, None));
            }
        }
        let control = |(path, text): &(String, Option<String>)| {
            let key = NumericKey::find(self.spec(), path).ok()?;
            self.control(&key, text.as_deref())
        };
        keys.iter().filter_map(control).collect()
    }

    /// Returns the strain limits of the patches that have none.
    pub fn optional_keys(&self) -> Vec<OptionalKey> {
        let mut limited = self.spec().clone();
        limited
            .patch
            .retain(|_, patch| patch.strain_limit.is_none());
        for patch in limited.patch.values_mut() {
            patch.strain_limit = Some(f64::EPSILON);
        }
        let optional = |name: &String| {
            let key = NumericKey::find(&limited, &format!("patch.{name}.strain_limit")).ok()?;
            Some(OptionalKey {
                key: key.path().to_owned(),
                unit: "ppm",
                about: key.about(),
            })
        };
        limited.patch.keys().filter_map(optional).collect()
    }

    /// Returns one control. Numbers are shown in the unit of the file.
    fn control(&self, key: &NumericKey, file_text: Option<&str>) -> Option<DesignControl> {
        let value = key.get(self.spec()).ok()?;
        let shown = key.show(value);
        let number_and_unit = [file_text.unwrap_or_default(), &shown]
            .into_iter()
            .find_map(split);
        let (unit, factor) = match number_and_unit {
            Some((number, unit)) if number != 0.0 => (unit, value / number),
            Some((_, unit)) if !unit.is_empty() => {
                let factor = key.size_of(&unit).unwrap_or(1.0);
                (unit, factor)
            }
            _ => (key.unit(), 1.0),
        };
        let (low, high) = key.limits();
        let limits = (low, high.min(self.room_on_beam(key).unwrap_or(high)));
        let scale = slider_scale(key, value, limits.0);
        let (from, to) = slider_ends(scale, value, factor, limits);
        Some(DesignControl {
            key: key.path().to_owned(),
            value,
            shown,
            unit,
            factor,
            about: key.about(),
            scale,
            from,
            to,
            count: key.is_count(),
            written: file_text.is_some(),
        })
    }

    /// Returns the largest value of a key with which a point or a patch stays on its beam, m.
    fn room_on_beam(&self, key: &NumericKey) -> Option<f64> {
        let length_m = |beam: &str| Some(self.spec().beam.get(beam)?.length_m);
        let parts: Vec<&str> = key.path().split('.').collect();
        match parts[..] {
            ["beam", beam, "point", _] => length_m(beam),
            ["patch", name, which @ ("start" | "length")] => {
                let patch = self.spec().patch.get(name)?;
                let taken_m = if which == "start" {
                    patch.length_m
                } else {
                    patch.start_m
                };
                Some(length_m(&patch.on)? - taken_m)
            }
            _ => None,
        }
    }
}

/// Splits a text into number and unit.
fn split(text: &str) -> Option<(f64, String)> {
    let end = text
        .find(|letter: char| !letter.is_ascii_digit() && !"+-.eE".contains(letter))
        .unwrap_or(text.len());
    Some((text[..end].parse().ok()?, text[end..].trim().to_owned()))
}

fn slider_scale(key: &NumericKey, value: f64, low: f64) -> SliderScale {
    let linear = matches!(key.unit().as_str(), "m" | "Hz" | "s" | "rad" | "") || key.is_count();
    if linear || value <= 0.0 || low < 0.0 && key.path().ends_with(".d31") {
        SliderScale::Linear
    } else {
        SliderScale::Log
    }
}

/// Returns the ends of a slider. `factor` is the size of the unit in which the value is shown.
fn slider_ends(scale: SliderScale, value: f64, factor: f64, (low, high): (f64, f64)) -> (f64, f64) {
    let at_zero = ZERO_SPAN * factor;
    let (from, to) = match scale {
        SliderScale::Log => (value / LOG_RATIO, value * LOG_RATIO),
        SliderScale::Linear if value == 0.0 => (if low < 0.0 { -at_zero } else { 0.0 }, at_zero),
        SliderScale::Linear if value < 0.0 => (LINEAR_RATIO * value, 0.0),
        SliderScale::Linear => (LINEAR_LOW_RATIO * value, LINEAR_RATIO * value),
    };
    (from.max(low), to.min(high))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::harvester::Harvester;

    #[test]
    fn every_number_of_the_paper_has_a_control() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/impact-harvester-2019/harvester.toml"
        );
        let design = Design::new(&Harvester::read(path).unwrap(), &[]).unwrap();
        let keys = design.controls();
        let find = |key: &str| keys.iter().find(|control| control.key == key).cloned();
        let gap = find("stop.tip.gap").unwrap();
        assert_eq!((gap.unit.as_str(), gap.scale), ("mm", SliderScale::Linear));
        assert!((gap.factor - 1e-3).abs() < 1e-15);
        let load = find("circuit.load.resistance").unwrap();
        assert_eq!(
            (load.scale, load.from, load.to),
            (SliderScale::Log, 1e5, 1e7)
        );
        assert!(find("beam.beam.point.tip").unwrap().written);
        assert!(find("drive.shaker.phase").is_none_or(|phase| !phase.written));
        assert!(find("run.start").is_none() && find("drive.shaker.at").is_none());
    }

    #[test]
    fn a_value_of_zero_retains_its_unit_and_points_and_patches_stay_on_their_beam() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/impact-harvester-2019/harvester.toml"
        );
        let set = [("stop.tip.gap".to_owned(), "0 mm".to_owned())];
        let design = Design::new(&Harvester::read(path).unwrap(), &set).unwrap();
        let keys = design.controls();
        let find = |key: &str| keys.iter().find(|control| control.key == key).unwrap();
        let gap = find("stop.tip.gap");
        assert_eq!((gap.unit.as_str(), gap.factor), ("mm", 1e-3));
        assert!(gap.to <= 0.011, "{}", gap.to);
        let length = find("beam.beam.length").value;
        assert_eq!(find("beam.beam.point.tip").to, length);
        let [start, patch] = ["start", "length"].map(|end| find(&format!("patch.mfc.{end}")));
        for end in [start.to + patch.value, start.value + patch.to] {
            assert!(end <= length * (1.0 + 1e-12), "{end} {length}");
        }
    }

    #[test]
    fn a_text_is_split_into_number_and_unit() {
        assert_eq!(split("0.5 mm"), Some((0.5, "mm".to_owned())));
        assert_eq!(split("1e-3m"), Some((1e-3, "m".to_owned())));
        assert_eq!(split("table"), None);
    }
}
