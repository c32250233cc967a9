//! Natural frequencies and damping ratios as features.

use std::f64::consts::TAU;

use jounce_model::plant::{BlockPair, Plant, PlantError, System};
use jounce_model::structure::{self, Modes};
use jounce_spec::{Gravity, Quantity, Spec};
use toml_edit::Item;

use super::table::{FeatureTable, positive};
use crate::fit::model::Conditions;
use crate::fit::{Deviation, FeatureModel, FitError, FitModel};

/// A measured mode.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ModeFeature {
    /// Number in the model, from 1.
    pub number: usize,
    /// Frequency, Hz, and its relative standard deviation.
    pub frequency: Option<(f64, Deviation)>,
    /// Damping ratio and its relative standard deviation.
    pub damping_ratio: Option<(f64, Deviation)>,
    /// True for a mode of the harvester with its circuits connected: stiffer and more damped than
    /// with short-circuited patches.
    pub loaded: bool,
    /// Keys that apply during the test.
    pub set: Vec<(String, String)>,
}

const KEYS: [&str; 7] = [
    "number",
    "frequency",
    "frequency_deviation",
    "damping_ratio",
    "damping_deviation",
    "loaded",
    "set",
];

impl ModeFeature {
    pub(super) fn read(
        reader: &mut FeatureTable<'_>,
        defaults: [Option<Deviation>; 2],
    ) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let number = reader
            .table
            .get("number")
            .and_then(Item::as_integer)
            .and_then(|number| usize::try_from(number).ok());
        let number = number.filter(|number| *number > 0);
        if number.is_none() {
            reader.fault("number", "number must be a whole number from 1");
        }
        let explicit_deviations = [
            reader.given_deviation("frequency_deviation"),
            reader.given_deviation("damping_deviation"),
        ];
        let frequency_hz = reader
            .table
            .contains_key("frequency")
            .then(|| reader.quantity("frequency", Quantity::Frequency, "9.01 Hz"));
        let damping = reader.table.get("damping_ratio").map(positive);
        if damping == Some(None) {
            reader.fault("damping_ratio", "damping_ratio must be a number above 0");
        }
        if frequency_hz.is_none() && damping.is_none() {
            reader.fault("frequency", "frequency and damping_ratio are both missing");
        }
        let mut with = |value: Option<Option<f64>>, k: usize, name: &str| {
            let value = value.flatten()?;
            let deviation = explicit_deviations[k].or(defaults[k]);
            if deviation.is_none() {
                reader.fault(name, format!(
                    "{name} is missing: expected the relative standard deviation, such as 0.002, \
                    or \"residuals\", here or at the top of the file"
                ));
            }
            Some((value, deviation?))
        };
        let (frequency, damping_ratio) = (
            with(frequency_hz, 0, "frequency_deviation"),
            with(damping, 1, "damping_deviation"),
        );
        let (loaded, set) = (reader.flag("loaded"), reader.conditions());
        Some(Self {
            number: number?,
            frequency,
            damping_ratio,
            loaded,
            set,
        })
    }

    /// Suffix of the name: the conditions, and that circuits are connected.
    pub(in crate::fit) fn conditions_in_words(&self) -> String {
        let set = self
            .set
            .iter()
            .map(|(key, value)| format!("{key} = {value}"));
        let words: Vec<String> = self
            .loaded
            .then(|| "loaded".to_owned())
            .into_iter()
            .chain(set)
            .collect();
        if words.is_empty() {
            String::new()
        } else {
            format!(" ({})", words.join(", "))
        }
    }
}

/// Modes under the same conditions.
pub(in crate::fit) struct ModeModel {
    /// Mode numbers from 0, with true for a frequency, false for a damping ratio.
    pub requested: Vec<(usize, bool)>,
    pub loaded: bool,
    pub conditions: Conditions,
}

impl FeatureModel for ModeModel {
    fn predict(&self, model: &FitModel<'_>) -> Result<Vec<f64>, FitError> {
        let spec = model.spec_at(&self.conditions)?;
        let modes = structure::modes_holding(&spec, model.hold)?;
        let poles = if self.loaded {
            loaded(spec, modes)?
        } else {
            modes
                .frequency_rad_s
                .into_iter()
                .zip(modes.damping_ratio)
                .collect()
        };
        let value = |&(mode, is_frequency): &(usize, bool)| {
            let Some((angular, damping_ratio)) = poles.get(mode).copied() else {
                return Err(FitError::NoMode {
                    number: mode + 1,
                    modes: poles.len(),
                });
            };
            match (is_frequency, damping_ratio > 0.0) {
                (true, _) => Ok(angular / TAU),
                (false, true) => Ok(damping_ratio),
                (false, false) => Err(FitError::Undamped {
                    number: mode + 1,
                    damping_ratio,
                }),
            }
        };
        self.requested.iter().map(value).collect()
    }
}

/// Undamped frequency, rad/s, and damping ratio of every mode of the structure with its circuits:
/// `|p|` and `-re p / |p|` of the oscillatory poles `p`, in ascending frequency after the
/// rigid-body modes.
fn loaded(mut spec: Spec, modes: Modes) -> Result<Vec<(f64, f64)>, FitError> {
    spec.take_drives_away();
    spec.stop.clear();
    spec.gravity = Gravity::default();
    let rigid = modes.frequency_rad_s.iter().filter(|w| **w == 0.0).count();
    let plant = Plant::new(System::assemble(&spec, modes)?)?;
    if let Some(bridge) = plant.system.bridges.first() {
        return Err(PlantError::Switches {
            circuit: bridge.name.clone(),
        }
        .into());
    }
    let is_oscillating = |pair: &BlockPair| match *pair {
        BlockPair::Oscillatory { decay, frequency } => {
            Some((decay.hypot(frequency), -decay / decay.hypot(frequency)))
        }
        BlockPair::Jordan { .. } | BlockPair::FreeBody { .. } => None,
    };
    let mut poles: Vec<(f64, f64)> = plant
        .diagonal
        .block
        .pairs
        .iter()
        .filter_map(is_oscillating)
        .collect();
    poles.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(std::iter::repeat_n((0.0, 0.0), rigid)
        .chain(poles)
        .collect())
}
