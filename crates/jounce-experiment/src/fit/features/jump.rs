//! Jumps as features: the value of a key at a fold of a branch of periodic responses.

use jounce_analysis::{BranchKind, BranchSearch, OrbitMethodKind, Parameter};
use jounce_spec::NumericKey;

use super::table::FeatureTable;
use crate::fit::model::Conditions;
use crate::fit::{Deviation, FeatureModel, FitError, FitModel};

/// A measured jump.
#[derive(Debug, Clone, PartialEq)]
pub struct JumpFeature {
    /// Swept key.
    pub over: String,
    /// Value at the jump, in command-line notation.
    pub at: String,
    /// Range of continuation; its ends must be on both sides of the jump.
    pub between: [String; 2],
    /// Relative standard deviation of the value.
    pub deviation: Deviation,
    /// Keys that apply during the test.
    pub set: Vec<(String, String)>,
}

const KEYS: [&str; 5] = ["over", "at", "between", "deviation", "set"];

impl JumpFeature {
    pub(super) fn read(reader: &mut FeatureTable<'_>) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let (over, at) = (
            reader.text("over", "drive.shaker.frequency"),
            reader.text("at", "12.6 Hz"),
        );
        let between = reader.texts("between", "12 Hz");
        let between: Result<[String; 2], _> = between.try_into();
        if between.is_err() {
            reader.fault(
                "between",
                "between must be two values on both sides of the jump, such as between = \
                [\"12 Hz\", \"13 Hz\"]",
            );
        }
        let (deviation, set) = (reader.own_deviation(), reader.conditions());
        Some(Self {
            over: over?,
            at: at?,
            between: between.ok()?,
            deviation,
            set,
        })
    }
}

/// Fold nearest to the measured jump, on the branches through both ends of a range.
pub(in crate::fit) struct JumpModel {
    pub key: NumericKey,
    pub at: f64,
    pub range: (f64, f64),
    pub conditions: Conditions,
}

impl FeatureModel for JumpModel {
    fn predict(&self, model: &FitModel<'_>) -> Result<Vec<f64>, FitError> {
        let harvester = model.model_at(&self.conditions)?;
        let parameter = Parameter::new(&harvester, &self.key, self.range.1 - self.range.0);
        let search = BranchSearch {
            base: &harvester,
            parameter: &parameter,
            range: self.range,
            method: OrbitMethodKind::Shooting,
            tolerance: harvester.spec.run.tolerance,
            seeds: 0,
            longest_period: 1,
        };
        let branches = search
            .run()
            .map_err(|fault| FitError::Orbit(fault.to_string()))?;
        let folds = branches
            .iter()
            .flat_map(|branch| &branch.bifurcations)
            .filter(|result| result.kind == BranchKind::Fold);
        let nearest_fold = folds
            .map(|fold| fold.at.parameter)
            .min_by(|a, b| (a - self.at).abs().total_cmp(&(b - self.at).abs()));
        let no_jump = FitError::NoJump {
            key: self.key.path().to_owned(),
            low: self.key.show(self.range.0),
            high: self.key.show(self.range.1),
        };
        Ok(vec![nearest_fold.ok_or(no_jump)?])
    }
}
