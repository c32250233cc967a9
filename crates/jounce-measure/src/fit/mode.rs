//! Natural frequencies and damping ratios as features.

use std::f64::consts::TAU;

use jounce::spec::Quantity;
use jounce::structure;
use toml_edit::Item;

use super::reading::{Reader, positive};
use super::{Deviation, FitError, Model, Question};

/// A measured mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeFeature {
    /// Its number in the model, from 1.
    pub number: usize,
    /// Frequency, Hz, and its relative standard deviation.
    pub frequency: Option<(f64, Deviation)>,
    /// Damping ratio and its relative standard deviation.
    pub damping_ratio: Option<(f64, Deviation)>,
}

const KEYS: [&str; 5] = ["number", "frequency", "frequency_deviation", "damping_ratio", "damping_deviation"];

impl ModeFeature {
    pub(super) fn read(reader: &mut Reader<'_>, usual: [Option<Deviation>; 2]) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let number = reader.table.get("number").and_then(Item::as_integer).and_then(|number| usize::try_from(number).ok());
        let number = number.filter(|number| *number > 0);
        if number.is_none() {
            reader.fault("number must be a whole number from 1");
        }
        let own = [reader.deviation("frequency_deviation"), reader.deviation("damping_deviation")];
        let frequency_hz = reader.table.contains_key("frequency").then(|| reader.quantity("frequency", Quantity::Frequency, "9.01 Hz"));
        let damping = reader.table.get("damping_ratio").map(positive);
        if damping == Some(None) {
            reader.fault("damping_ratio must be a number above 0");
        }
        if frequency_hz.is_none() && damping.is_none() {
            reader.fault("there is neither frequency nor damping_ratio");
        }
        let mut with = |value: Option<Option<f64>>, k: usize, name: &str| {
            let value = value.flatten()?;
            let deviation = own[k].or(usual[k]);
            if deviation.is_none() {
                reader.fault(format!(
                    "{name} is missing: the relative standard deviation, as in 0.002, or \"residuals\", here or at the top of the file"
                ));
            }
            Some((value, deviation?))
        };
        let (frequency, damping_ratio) = (with(frequency_hz, 0, "frequency_deviation"), with(damping, 1, "damping_deviation"));
        Some(Self { number: number?, frequency, damping_ratio })
    }
}

/// Numbers of modes, from 0, and whether their frequency or their damping ratio is asked for.
pub(super) struct AskedModes(pub Vec<(usize, bool)>);

impl Question for AskedModes {
    fn ask(&self, model: &Model<'_>) -> Result<Vec<f64>, FitError> {
        let modes = structure::modes_holding(&model.spec, model.hold)?;
        let value = |&(mode, is_frequency): &(usize, bool)| {
            if mode >= modes.len() {
                return Err(FitError::NoMode { number: mode + 1, modes: modes.len() });
            }
            let damping_ratio = modes.damping_ratio[mode];
            match (is_frequency, damping_ratio > 0.0) {
                (true, _) => Ok(modes.frequency_rad_s[mode] / TAU),
                (false, true) => Ok(damping_ratio),
                (false, false) => Err(FitError::Undamped { number: mode + 1, damping_ratio }),
            }
        };
        self.0.iter().map(value).collect()
    }
}
