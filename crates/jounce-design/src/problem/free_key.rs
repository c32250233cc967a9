//! Free keys: ranges of numbers, and choices.

use jounce_spec::{Faults, KeyRange, NumericKey, Spec, SpecFile};

/// A key that the search may set.
#[derive(Debug, Clone)]
pub struct FreeKey {
    /// Dotted path.
    pub path: String,
    /// Allowed values.
    pub values: FreeValues,
}

/// Allowed values of a free key.
#[derive(Debug, Clone)]
pub enum FreeValues {
    /// All numbers between two ends.
    Range {
        /// The key.
        key: Box<NumericKey>,
        /// Smallest value, SI.
        low: f64,
        /// Largest value, SI.
        high: f64,
        /// True where the logarithm of the value is searched evenly.
        logarithmic: bool,
    },
    /// Some texts, such as names of materials.
    Choice(Vec<String>),
}

impl FreeKey {
    /// Reads `FROM:TO` or `FROM:TO:log`, each with its unit or with one unit at the end.
    ///
    /// # Errors
    /// A message with the mistake and what is allowed.
    pub(super) fn range(file: &SpecFile, path: &str, text: &str) -> Result<Self, Vec<String>> {
        let key = file.numeric_key(path).map_err(|faults| messages(&faults))?;
        let wrong = || {
            vec![format!(
                "{path}: {text:?} is no range; write FROM:TO, or FROM:TO:log above 0, from a smaller to a larger value"
            )]
        };
        let logarithmic = text.contains(":log");
        let ends = text.replacen(":log", "", 1);
        let (from, to) = ends.split_once(':').ok_or_else(wrong)?;
        let unit = if from.trim().parse::<f64>().is_ok() {
            unit_of(to)
        } else {
            ""
        };
        let range = KeyRange::parse(key, &format!("{from} {unit},{to}"))
            .map_err(|fault| vec![fault.message])?;
        let [low, high] = range.values()[..] else {
            return Err(wrong());
        };
        if low >= high || (logarithmic && low <= 0.0) {
            return Err(wrong());
        }
        let key = Box::new(range.key().clone());
        let values = FreeValues::Range {
            key,
            low,
            high,
            logarithmic,
        };
        Ok(Self {
            path: path.to_owned(),
            values,
        })
    }

    /// Returns the number at a place in [0, 1], SI; NaN for a choice.
    pub fn value(&self, place: f64) -> f64 {
        let FreeValues::Range {
            key,
            low,
            high,
            logarithmic,
        } = &self.values
        else {
            return f64::NAN;
        };
        let value = match logarithmic {
            true => low * (high / low).powf(place),
            false => low + (high - low) * place,
        };
        let value = if key.is_count() { value.round() } else { value };
        value.clamp(*low, *high)
    }

    /// Returns the place of the value in a spec; `None` outside the range. The first choice stands
    /// for the given text.
    pub(crate) fn place(&self, spec: &Spec) -> Option<f64> {
        let FreeValues::Range {
            key,
            low,
            high,
            logarithmic,
        } = &self.values
        else {
            return Some(0.0);
        };
        let value = key.get(spec).ok()?;
        let place = match logarithmic {
            true => (value / low).ln() / (high / low).ln(),
            false => (value - low) / (high - low),
        };
        (0.0..=1.0).contains(&place).then_some(place)
    }

    /// Returns the derivative of the number by the place.
    pub(crate) fn slope(&self, place: f64) -> f64 {
        match &self.values {
            FreeValues::Range {
                low,
                high,
                logarithmic: true,
                ..
            } => self.value(place) * (high / low).ln(),
            FreeValues::Range { low, high, .. } => high - low,
            FreeValues::Choice(_) => 0.0,
        }
    }

    /// Returns the index of the choice at a place.
    pub(crate) fn choice(&self, place: f64) -> usize {
        match &self.values {
            FreeValues::Choice(texts) => {
                ((place * texts.len() as f64) as usize).min(texts.len() - 1)
            }
            FreeValues::Range { .. } => 0,
        }
    }

    /// Returns the numeric key if results have a derivative by it.
    pub(crate) fn smooth(&self) -> Option<&NumericKey> {
        match &self.values {
            FreeValues::Range { key, .. } if !key.is_count() => Some(key),
            FreeValues::Range { .. } | FreeValues::Choice(_) => None,
        }
    }

    /// Returns the value at a place as text with its unit, as `--set` takes it.
    pub fn text(&self, place: f64) -> String {
        match &self.values {
            FreeValues::Choice(texts) => texts[self.choice(place)].clone(),
            FreeValues::Range { key, .. } if key.is_count() => format!("{}", self.value(place)),
            FreeValues::Range { key, .. } => {
                let text = format!("{:?} {}", self.value(place), key.unit());
                text.trim_end().to_owned()
            }
        }
    }
}

/// Returns the messages of faults.
pub(super) fn messages(faults: &Faults) -> Vec<String> {
    let all = faults.as_slice().iter();
    all.map(|fault| fault.message.clone()).collect()
}

/// Returns what follows the longest number at the start of a text.
fn unit_of(text: &str) -> &str {
    let number = (0..=text.len())
        .rev()
        .filter_map(|end| text.get(..end))
        .find(|number| number.trim().parse::<f64>().is_ok());
    text[number.map_or(0, str::len)..].trim()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    const SPEC: &str = "[modal.m]\nfrequency_hz = [10.0]\ndamping_ratio = [0.01]\n[modal.m.point]\ntip = [1.0]\n\
        [stop.s]\nat = \"m.tip\"\nlaw = \"hertz\"\ngap = \"1 mm\"\nstiffness = \"1000 N/m^1.5\"\n\
        [drive.d]\nat = \"m.tip\"\nkind = \"force\"\namplitude = \"1 N\"\nfrequency = \"9 Hz\"\n\
        [run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";

    #[test]
    fn a_range_has_units_at_its_ends_or_one_for_both() {
        let file = SpecFile::from_text(SPEC);
        let range = |path: &str, text: &str| FreeKey::range(&file, path, text).unwrap();
        let gap = range("stop.s.gap", "0.2mm:3mm");
        assert_eq!((gap.value(0.0), gap.value(1.0)), (0.2e-3, 3e-3));
        let spaced = range("stop.s.gap", "0.2 mm:3 mm");
        assert_eq!((spaced.value(0.0), spaced.value(1.0)), (0.2e-3, 3e-3));
        for text in ["100:1e5:log N/m^1.5", "100 N/m^1.5:1e5 N/m^1.5:log"] {
            let stiffness = range("stop.s.stiffness", text);
            assert!((stiffness.value(0.5) / 1e3_f64.powf(0.5) / 100.0 - 1.0).abs() < 1e-12);
            let place = stiffness.place(&file.spec().unwrap()).unwrap();
            assert!((stiffness.value(place) / 1000.0 - 1.0).abs() < 1e-12);
        }
        assert_eq!(gap.text(1.0), "0.003 m");
    }

    #[test]
    fn empty_and_reversed_ranges_are_refused() {
        let file = SpecFile::from_text(SPEC);
        for text in [
            "3mm:1mm",
            "1mm:1mm",
            "1mm",
            "0mm:1mm:log",
            "1mm:2mm:5x",
            "a:b",
        ] {
            let faults = FreeKey::range(&file, "stop.s.gap", text).unwrap_err();
            assert!(faults[0].contains("stop.s.gap"), "{text}: {faults:?}");
        }
    }
}
