//! Why the solutions of a model cannot be found.

use jounce::analysis::AnalysisError;
use jounce::orbit::OrbitError;
use jounce::plant::PlantError;
use jounce::run::RunError;
use jounce::spec::Fault;

/// A model without solutions to compare with.
#[derive(Debug, thiserror::Error)]
pub enum SolutionError {
    /// Not one sinusoidal drive.
    #[error("the model has {found} sinusoidal drives; a record of one solution needs exactly one")]
    Drives {
        /// How many there are.
        found: usize,
    },
    /// Nothing to look at.
    #[error(
        "the model has no resistor whose voltage could be compared; give it a [circuit.NAME] with a resistance"
    )]
    NoLoad,
    /// A circuit that is not there.
    #[error("the model has no circuit `{wanted}`; there are {known}")]
    UnknownLoad {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
    /// A solution that the model has not, or that has no orbit to start on.
    #[error("there is no solution `{wanted}` to start on; the model's solutions are {known}")]
    UnknownSolution {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
    /// No march succeeded.
    #[error("none of {starts} starts could be marched; the first: {first}")]
    Lost {
        /// How many starts.
        starts: usize,
        /// Why the first failed.
        first: String,
    },
    /// A key of the spec.
    #[error(transparent)]
    Key(#[from] Fault),
    /// The harvester.
    #[error(transparent)]
    Study(#[from] AnalysisError),
    /// The plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// A march.
    #[error(transparent)]
    Run(#[from] RunError),
    /// An orbit.
    #[error(transparent)]
    Orbit(#[from] OrbitError<AnalysisError>),
}
