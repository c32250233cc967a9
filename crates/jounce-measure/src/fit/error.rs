//! Why a spec is not fitted.

use std::path::PathBuf;

use jounce::spec::{Fault, Faults};
use jounce::structure::StructureError;

/// A fit that cannot be done.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// The features cannot be read.
    #[error("{}: {reason}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: std::io::Error,
    },
    /// The features hold faults; all of them.
    #[error("{}", faults.join("; "))]
    Features {
        /// One sentence each.
        faults: Vec<String>,
    },
    /// A key that the spec does not have.
    #[error("free.{key}: {faults}")]
    Key {
        /// The key.
        key: String,
        /// What is wrong.
        faults: Faults,
    },
    /// A key at 0: relative deviations mean nothing there.
    #[error(
        "free.{key} is {value} in the spec; a key that is fitted needs a start value other than 0"
    )]
    Start {
        /// The key.
        key: String,
        /// Its value.
        value: f64,
    },
    /// A number of a list that is free by itself and with its list.
    #[error(
        "{key} is free twice, by itself and with its list; name the list, or its numbers one by one"
    )]
    Twice {
        /// The key.
        key: String,
    },
    /// A mode that the model does not have.
    #[error(
        "mode {number} is measured and the model has {modes}; raise reduction.modes, or correct the number"
    )]
    NoMode {
        /// Its number.
        number: usize,
        /// Modes of the model.
        modes: usize,
    },
    /// A damping ratio of 0 in the model, which no change of keys makes another.
    #[error(
        "mode {number} has a damping ratio of {damping_ratio} in the model; a damping ratio to be fitted must be above 0"
    )]
    Undamped {
        /// The mode.
        number: usize,
        /// Its damping ratio.
        damping_ratio: f64,
    },
    /// A condition of a test that the spec refuses.
    #[error("{place}, set.{key}: {reason}")]
    Condition {
        /// The test.
        place: String,
        /// The key.
        key: String,
        /// What is wrong.
        reason: String,
    },
    /// A recording of a test that cannot be used.
    #[error("{place}, {}: {reason}", path.display())]
    File {
        /// The test.
        place: String,
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A point or patch that the model does not have.
    #[error("there is no point or patch {name:?} in the model; there are {known}")]
    NoPlace {
        /// What was asked for.
        name: String,
        /// What there is.
        known: String,
    },
    /// A model without power.
    #[error(
        "the model gives a mean power of {mean_power_w} W where one was measured; has it a load, a drive, and long enough a run?"
    )]
    NoPower {
        /// Its mean power, W.
        mean_power_w: f64,
    },
    /// No fold where a jump was measured.
    #[error(
        "no branch through {key} = {low} or {high} turns back between them; widen `between`, or correct the start values of the free keys"
    )]
    NoJump {
        /// The key.
        key: String,
        /// Lower end.
        low: String,
        /// Upper end.
        high: String,
    },
    /// Deviations that the residuals cannot tell.
    #[error(
        "{features} of {name} cannot tell their own deviation, since the fit takes up {taken:.1} of them; give the deviation, or free fewer keys"
    )]
    NoResiduals {
        /// The features.
        name: String,
        /// Their number.
        features: usize,
        /// Keys that they determine.
        taken: f64,
    },
    /// Branches that cannot be followed.
    #[error("{0}")]
    Orbit(String),
    /// What the plant refuses.
    #[error(transparent)]
    Plant(#[from] jounce::plant::PlantError),
    /// What a march or a study refuses.
    #[error(transparent)]
    Study(#[from] jounce::analysis::AnalysisError),
    /// A value that the spec refuses.
    #[error(transparent)]
    Value(#[from] Fault),
    /// A structure without modes.
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
    /// Somebody wished that it ends.
    #[error("the fit was stopped after {evaluations} evaluations")]
    Stopped {
        /// Evaluations of the model.
        evaluations: usize,
    },
}
