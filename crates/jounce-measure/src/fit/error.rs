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
    #[error("free.{key} is {value} in the spec; a key that is fitted needs a start value other than 0")]
    Start {
        /// The key.
        key: String,
        /// Its value.
        value: f64,
    },
    /// A mode that the model does not have.
    #[error("mode {number} is measured and the model has {modes}; raise reduction.modes, or correct the number")]
    NoMode {
        /// Its number.
        number: usize,
        /// Modes of the model.
        modes: usize,
    },
    /// A damping ratio of 0 in the model, which no change of keys makes another.
    #[error("mode {number} has a damping ratio of {damping_ratio} in the model; a damping ratio to be fitted must be above 0")]
    Undamped {
        /// The mode.
        number: usize,
        /// Its damping ratio.
        damping_ratio: f64,
    },
    /// A value that the spec refuses.
    #[error(transparent)]
    Value(#[from] Fault),
    /// A structure without modes.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The fit does not converge.
    #[error("the fit does not converge after {evaluations} evaluations; free fewer keys, or give them smaller deviations")]
    NotConverged {
        /// Evaluations of the model.
        evaluations: usize,
    },
}
