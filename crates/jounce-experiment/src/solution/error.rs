//! Errors of issue the solutions of a model.

use jounce_analysis::AnalysisError;
use jounce_analysis::run::RunError;
use jounce_model::plant::PlantError;
use jounce_orbits::OrbitError;
use jounce_spec::Fault;

/// Error of a model without usable solutions.
#[derive(Debug, thiserror::Error)]
pub enum SolutionError {
    /// The model does not have exactly one sinusoidal drive.
    #[error("the model has {found} sinusoidal drives; a record of one solution needs exactly one")]
    Drives {
        /// Number of sinusoidal drives.
        found: usize,
    },
    /// There is no voltage to compare.
    #[error(
        "the model has no resistor whose voltage could be compared; give it a [circuit.NAME] with a resistance"
    )]
    NoLoad,
    /// The circuit does not exist.
    #[error("the model has no circuit `{requested}`; there are {known}")]
    UnknownLoad {
        /// Requested name.
        requested: String,
        /// Existing names.
        known: String,
    },
    /// The solution does not exist, or has no orbit as a start.
    #[error("there is no solution `{requested}` to start on; the model's solutions are {known}")]
    UnknownSolution {
        /// Requested id.
        requested: String,
        /// Existing ids.
        known: String,
    },
    /// All runs failed.
    #[error("all runs from {starts} starts failed; the first error: {first}")]
    Lost {
        /// Number of starts.
        starts: usize,
        /// Error of the first run.
        first: String,
    },
    /// Error of a key of the spec.
    #[error(transparent)]
    Key(#[from] Fault),
    /// Error of the analysis.
    #[error(transparent)]
    Study(#[from] AnalysisError),
    /// Error of the plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// Error of a run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Error of an orbit.
    #[error(transparent)]
    Orbit(#[from] OrbitError<AnalysisError>),
}
