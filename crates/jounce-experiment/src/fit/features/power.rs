//! Mean powers over a key, such as the load, as features.

use jounce_analysis::AnalysisError;
use jounce_analysis::run::{RunPlan, simulate};

use super::table::FeatureTable;
use crate::fit::model::Conditions;
use crate::fit::{Deviation, FeatureModel, FitError, FitModel};

/// Measured mean powers over one key.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerFeature {
    /// Swept key.
    pub over: String,
    /// Values, in command-line notation.
    pub values: Vec<String>,
    /// Mean power at each value, W.
    pub mean_power_w: Vec<f64>,
    /// Relative standard deviation of each power.
    pub deviation: Deviation,
    /// Keys that apply during the test.
    pub set: Vec<(String, String)>,
}

const KEYS: [&str; 5] = ["over", "values", "mean_power_w", "deviation", "set"];

impl PowerFeature {
    pub(super) fn read(reader: &mut FeatureTable<'_>) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let over = reader.text("over", "circuit.load.resistance");
        let values = reader.texts("values", "100 kohm");
        let mean_power_w = reader.numbers("mean_power_w", values.len());
        if mean_power_w.iter().any(|power| *power <= 0.0) {
            reader.fault(
                "mean_power_w",
                "mean_power_w must contain numbers above 0, in watts",
            );
        }
        let (deviation, set) = (reader.own_deviation(), reader.conditions());
        Some(Self {
            over: over?,
            values,
            mean_power_w,
            deviation,
            set,
        })
    }
}

/// Mean power of one run of `run.duration` for each condition.
pub(in crate::fit) struct PowerModel(pub Vec<Conditions>);

impl FeatureModel for PowerModel {
    fn predict(&self, model: &FitModel<'_>) -> Result<Vec<f64>, FitError> {
        let power = |conditions: &Conditions| {
            let harvester = model.model_at(conditions)?;
            let start = harvester.start(model.folder)?;
            let plan = RunPlan::of(&harvester.spec.run, 0.0);
            let kernel = harvester.from_state(&start)?;
            let run = simulate(&kernel, &start, &plan).map_err(AnalysisError::from)?;
            if run.mean_power_w > 0.0 {
                Ok(run.mean_power_w)
            } else {
                Err(FitError::NoPower {
                    mean_power_w: run.mean_power_w,
                })
            }
        };
        self.0.iter().map(power).collect()
    }
}
