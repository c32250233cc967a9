//! Errors of fitting a spec.

use std::path::PathBuf;

use jounce_model::structure::StructureError;
use jounce_spec::{Fault, Faults};

impl FitError {
    /// True for a fault of the features that shows only with the spec.
    pub fn is_of_features(&self) -> bool {
        matches!(
            self,
            Self::Key { .. }
                | Self::Start { .. }
                | Self::Twice { .. }
                | Self::NoMode { .. }
                | Self::Condition { .. }
                | Self::File { .. }
                | Self::NoPlace { .. }
                | Self::Structure(
                    StructureError::CannotHold { .. } | StructureError::CannotHoldGiven { .. }
                )
        )
    }
}

/// Error of a fit.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// The features file cannot be read.
    #[error("{}", jounce_io::store::unreadable(path, reason))]
    Open {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        reason: std::io::Error,
    },
    /// The features file contains faults; lists all of them.
    #[error("{}", faults.join("\n"))]
    Features {
        /// One sentence for each fault.
        faults: Vec<String>,
    },
    /// A key does not exist in the spec.
    #[error("free: {faults}")]
    Key {
        /// The key.
        key: String,
        /// The faults.
        faults: Faults,
    },
    /// A free key is 0, so relative deviations are undefined.
    #[error(
        "free.{key} is {value} in the spec; a key that is fitted needs a start value other than 0"
    )]
    Start {
        /// The key.
        key: String,
        /// Value.
        value: f64,
    },
    /// A number of a list is free both separately and with its list.
    #[error(
        "{key} is free twice, separately and with its list; name the list, or its numbers one by \
        one"
    )]
    Twice {
        /// The key.
        key: String,
    },
    /// A mode does not exist in the model.
    #[error(
        "mode {number} is measured, but the model has only {modes} modes; raise reduction.modes, \
        or correct the number"
    )]
    NoMode {
        /// Mode number.
        number: usize,
        /// Number of modes in the model.
        modes: usize,
    },
    /// The damping ratio in the model is 0, and no key can change it.
    #[error(
        "mode {number} has a damping ratio of {damping_ratio} in the model; a damping ratio to be fitted must be above 0"
    )]
    Undamped {
        /// The mode.
        number: usize,
        /// Damping ratio.
        damping_ratio: f64,
    },
    /// The spec refuses a condition of a test.
    #[error("{place}, set.{key}: {reason}")]
    Condition {
        /// The test.
        place: String,
        /// The key.
        key: String,
        /// The fault.
        reason: String,
    },
    /// A recording of a test cannot be used.
    #[error("{place}: {reason}")]
    File {
        /// The test.
        place: String,
        /// The file.
        path: PathBuf,
        /// The fault, with the path.
        reason: String,
    },
    /// A point or patch does not exist in the model.
    #[error("there is no point or patch {name:?} in the model; there are {known}")]
    NoPlace {
        /// Requested name.
        name: String,
        /// Existing names.
        known: String,
    },
    /// The mean power of the model is not positive.
    #[error(
        "the mean power of the model is {mean_power_w} W where a power was measured; check for a \
        load, a drive, and a sufficiently long run"
    )]
    NoPower {
        /// Mean power, W.
        mean_power_w: f64,
    },
    /// There is no fold in the range of a measured jump.
    #[error(
        "no branch through {key} = {low} or {high} has a fold between them; widen `between`, or \
        correct the start values of the free keys"
    )]
    NoJump {
        /// The key.
        key: String,
        /// Lower end.
        low: String,
        /// Upper end.
        high: String,
    },
    /// The residuals cannot determine a deviation.
    #[error(
        "{features} of {name} cannot determine their own deviation, because the fit uses \
        {taken:.1} degrees of freedom; give the deviation, or free fewer keys"
    )]
    NoResiduals {
        /// Name of the features.
        name: String,
        /// Number of features.
        features: usize,
        /// Number of keys that they determine.
        taken: f64,
    },
    /// Continuation of a branch failed.
    #[error("{0}")]
    Orbit(String),
    /// Error of the plant.
    #[error(transparent)]
    Plant(#[from] jounce_model::plant::PlantError),
    /// Error of a run or an analysis.
    #[error(transparent)]
    Study(#[from] jounce_analysis::AnalysisError),
    /// The spec refuses a value.
    #[error(transparent)]
    Value(#[from] Fault),
    /// The structure has no modes.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The fit does not converge.
    #[error(
        "the fit does not converge after {evaluations} evaluations; free fewer keys, or give them smaller deviations"
    )]
    NotConverged {
        /// Evaluations of the model.
        evaluations: usize,
    },
    /// The fit was cancelled.
    #[error("the fit was stopped after {evaluations} evaluations")]
    Stopped {
        /// Evaluations of the model.
        evaluations: usize,
    },
}
