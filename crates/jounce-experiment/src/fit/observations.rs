//! Measured numbers, and the model evaluations that correspond to them.

use jounce_spec::NumericKey;

use super::deviation::DeviationGroup;
use super::features::history::{HistoryModel, HistorySamples};
use super::features::jump::JumpModel;
use super::features::mode::ModeModel;
use super::features::power::PowerModel;
use super::features::response::{MeasuredLines, ResponseModel};
use super::measured::{MeasuredCurve, MeasuredNumber};
use super::model::{Conditions, FitSource};
use super::{
    Deviation, FeatureModel, Features, FitError, HistoryFeature, JumpFeature, ModeFeature,
    PowerFeature, ResponseFeature,
};

/// All model evaluations with all measured numbers, in the same order.
#[derive(Default)]
pub(super) struct Observations {
    pub feature_models: Vec<Box<dyn FeatureModel>>,
    pub measured: Vec<MeasuredNumber>,
    pub groups: Vec<DeviationGroup>,
    pub curves: Vec<MeasuredCurve>,
    /// Assumptions about ambiguous inputs, one sentence each.
    pub warnings: Vec<String>,
}

impl Observations {
    /// Reads the files and checks every key.
    pub fn of(source: FitSource<'_>, features: &Features) -> Result<Self, FitError> {
        let mut observations = Self::default();
        observations.modes(source, features)?;
        for (k, feature) in features.responses.iter().enumerate() {
            observations.response(source, features, feature, &format!("response {}", k + 1))?;
        }
        for (k, feature) in features.powers.iter().enumerate() {
            observations.powers(source, feature, &format!("power {}", k + 1))?;
        }
        for (k, feature) in features.jumps.iter().enumerate() {
            observations.jump(source, feature, &format!("jump {}", k + 1))?;
        }
        for (k, feature) in features.histories.iter().enumerate() {
            observations.history(source, features, feature, &format!("history {}", k + 1))?;
        }
        Ok(observations)
    }

    fn group(&mut self, name: &str, deviation: Deviation) -> usize {
        let group = DeviationGroup {
            name: name.to_owned(),
            deviation,
        };
        self.groups
            .iter()
            .position(|known| *known == group)
            .unwrap_or_else(|| {
                self.groups.push(group);
                self.groups.len() - 1
            })
    }

    fn number(&mut self, name: String, unit: &str, value: f64, group: usize) {
        self.measured.push(MeasuredNumber {
            name,
            unit: unit.to_owned(),
            value,
            scale: None,
            group,
            on: None,
        });
    }

    /// Groups modes by condition: one evaluation without conditions, and one for each condition.
    fn modes(&mut self, source: FitSource<'_>, features: &Features) -> Result<(), FitError> {
        let (unconditioned, conditioned): (Vec<_>, Vec<_>) = features
            .modes
            .iter()
            .enumerate()
            .partition(|(_, mode)| mode.set.is_empty() && !mode.loaded);
        let requested = unconditioned
            .into_iter()
            .flat_map(|(_, mode)| self.mode(mode))
            .collect::<Vec<_>>();
        if !requested.is_empty() {
            self.feature_models.push(Box::new(ModeModel {
                requested,
                loaded: false,
                conditions: Conditions::default(),
            }));
        }
        for (k, mode) in conditioned {
            let (requested, conditions) = (
                self.mode(mode),
                Conditions::new(source, &mode.set, &format!("mode {}", k + 1))?,
            );
            self.feature_models.push(Box::new(ModeModel {
                requested,
                loaded: mode.loaded,
                conditions,
            }));
        }
        Ok(())
    }

    /// Adds the numbers of a mode and returns the requested quantities.
    fn mode(&mut self, mode: &ModeFeature) -> Vec<(usize, bool)> {
        let (mut requested, words) = (Vec::new(), mode.conditions_in_words());
        if let Some((hz, deviation)) = mode.frequency {
            let group = self.group("frequencies", deviation);
            self.number(
                format!("mode {} frequency{words}", mode.number),
                "Hz",
                hz,
                group,
            );
            requested.push((mode.number - 1, true));
        }
        if let Some((ratio, deviation)) = mode.damping_ratio {
            let group = self.group("damping ratios", deviation);
            self.number(
                format!("mode {} damping ratio{words}", mode.number),
                "",
                ratio,
                group,
            );
            requested.push((mode.number - 1, false));
        }
        requested
    }

    fn response(
        &mut self,
        source: FitSource<'_>,
        features: &Features,
        feature: &ResponseFeature,
        position: &str,
    ) -> Result<(), FitError> {
        let conditions = Conditions::new(source, &feature.set, position)?;
        let group = self.group(position, feature.deviation);
        let (name, unit) = (
            feature.output.name(),
            feature.output.unit(&feature.input).to_owned(),
        );
        self.warnings.extend(feature.relative_in_words(position));
        let (lines, unit_warning) =
            feature
                .lines
                .read(&features.folder, position, &feature.channels())?;
        self.warnings.extend(unit_warning);
        let (complex, frequency_hz) = self.response_curves(lines, (&name, &unit), group);
        let (input, output, absolute) = (
            feature.input.clone(),
            feature.output.clone(),
            feature.absolute,
        );
        self.feature_models.push(Box::new(ResponseModel {
            input,
            output,
            absolute,
            frequency_hz,
            complex,
            conditions,
        }));
        Ok(())
    }

    /// Adds the sizes, or the real and imaginary parts, of a response; returns whether it is complex,
    /// and its frequencies.
    fn response_curves(
        &mut self,
        lines: MeasuredLines,
        (name, unit): (&str, &str),
        group: usize,
    ) -> (bool, Vec<f64>) {
        let curve = |component: &str| MeasuredCurve {
            name: format!("{name} {component}"),
            unit: unit.to_owned(),
            over: "frequency_hz",
        };
        match lines {
            MeasuredLines::Magnitude(frequency_hz, sizes) => {
                self.curve(curve("size"), (&frequency_hz, &sizes), |_| None, group);
                (false, frequency_hz)
            }
            MeasuredLines::Complex(frequency_hz, values) => {
                let (re, im): (Vec<f64>, Vec<f64>) = values.iter().map(|h| (h.re, h.im)).unzip();
                for (component, part) in [("real part", re), ("imaginary part", im)] {
                    let size = |k: usize| Some(values[k].norm());
                    self.curve(curve(component), (&frequency_hz, &part), size, group);
                }
                (true, frequency_hz)
            }
            MeasuredLines::File { .. } => (false, Vec::new()),
        }
    }

    fn curve(
        &mut self,
        curve: MeasuredCurve,
        (at, values): (&[f64], &[f64]),
        scale: impl Fn(usize) -> Option<f64>,
        group: usize,
    ) {
        let number = self.curves.len();
        let point = |(k, (at, value)): (usize, (&f64, &f64))| MeasuredNumber {
            name: curve.name.clone(),
            unit: curve.unit.clone(),
            value: *value,
            scale: scale(k),
            group,
            on: Some((number, *at)),
        };
        self.measured
            .extend(at.iter().zip(values).enumerate().map(point));
        self.curves.push(curve);
    }

    fn powers(
        &mut self,
        source: FitSource<'_>,
        feature: &PowerFeature,
        position: &str,
    ) -> Result<(), FitError> {
        let conditions = Conditions::new(source, &feature.set, position)?;
        let group = self.group(position, feature.deviation);
        let mut powers_at = Vec::new();
        for (value, power) in feature.values.iter().zip(&feature.mean_power_w) {
            let (key, value) = key_and_value(source, &feature.over, value, position)?;
            self.number(
                format!("mean power at {} = {}", feature.over, key.show(value)),
                "W",
                *power,
                group,
            );
            powers_at.push(conditions.with(&key, value));
        }
        self.feature_models.push(Box::new(PowerModel(powers_at)));
        Ok(())
    }

    fn jump(
        &mut self,
        source: FitSource<'_>,
        feature: &JumpFeature,
        position: &str,
    ) -> Result<(), FitError> {
        let conditions = Conditions::new(source, &feature.set, position)?;
        let value_of = |text: &str| key_and_value(source, &feature.over, text, position);
        let ((key, at), (_, low), (_, high)) = (
            value_of(&feature.at)?,
            value_of(&feature.between[0])?,
            value_of(&feature.between[1])?,
        );
        if !(low < at && at < high && at > 0.0) {
            let reason = format!(
                "{} is not between {} and {}, above 0",
                key.show(at),
                key.show(low),
                key.show(high)
            );
            return Err(FitError::Condition {
                place: position.to_owned(),
                key: feature.over.clone(),
                reason,
            });
        }
        let group = self.group(position, feature.deviation);
        self.number(format!("jump of {}", feature.over), &key.unit(), at, group);
        self.feature_models.push(Box::new(JumpModel {
            key,
            at,
            range: (low, high),
            conditions,
        }));
        Ok(())
    }

    fn history(
        &mut self,
        source: FitSource<'_>,
        features: &Features,
        feature: &HistoryFeature,
        position: &str,
    ) -> Result<(), FitError> {
        let conditions = Conditions::new(source, &feature.set, position)?;
        let HistorySamples {
            time_s,
            values,
            unit,
            starts_late,
        } = feature.samples(&features.folder, position)?;
        if starts_late {
            feature.within(&time_s, conditions.spec(source)?.run.duration_s, position)?;
            self.warnings
                .push(feature.late_start_warning(time_s[0], position));
        }
        let rms = (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt();
        let group = self.group(position, feature.deviation);
        let curve = MeasuredCurve {
            name: feature.output.name(),
            unit,
            over: "time_s",
        };
        self.curve(curve, (&time_s, &values), |_| Some(rms), group);
        self.feature_models.push(Box::new(HistoryModel {
            output: feature.output.clone(),
            time_s,
            conditions,
        }));
        Ok(())
    }
}

/// Parses a key and its value in command-line notation.
fn key_and_value(
    source: FitSource<'_>,
    key: &str,
    value: &str,
    position: &str,
) -> Result<(NumericKey, f64), FitError> {
    let result = Conditions::new(source, &[(key.to_owned(), value.to_owned())], position)?;
    Ok(result
        .first()
        .cloned()
        .expect("one key makes one condition"))
}
