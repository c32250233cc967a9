//! What a virtual rig cannot do.

use jounce::plant::PlantError;
use jounce::run::RunError;
use jounce::spec::RecordingError;

use jounce_data::recording::GridError;

/// A test that cannot be simulated.
#[derive(Debug, thiserror::Error)]
pub enum RigError {
    /// A number out of its range.
    #[error("{name} is {value}; it must be {allowed}")]
    Setting {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A mode that never dies.
    #[error(
        "the mode at {frequency_hz} Hz has no damping: its answer to a hit never ends; give it a damping ratio, or hold the body that moves"
    )]
    Undamped {
        /// Its frequency, Hz.
        frequency_hz: f64,
    },
    /// A record with its padding that is too long.
    #[error(
        "{samples} samples are needed until the slowest mode has died, more than {most}; lower the rate or raise the damping"
    )]
    Long {
        /// Samples needed.
        samples: f64,
        /// The most that are allowed.
        most: usize,
    },
    /// Bases that move against each other, where only the ground can be moved.
    #[error(
        "{what} moves the ground, but the spec has the base `{base}` beside it: let everything stand on the ground, or shake `{base}` by a drive of the spec"
    )]
    Bases {
        /// The first of the other bases.
        base: String,
        /// What moves the ground alone.
        what: &'static str,
    },
    /// A point that is not there.
    #[error("there is no point `{point}` for an accelerometer; there are {known}")]
    UnknownPoint {
        /// What was asked for.
        point: String,
        /// What there is.
        known: String,
    },
    /// A recording that moves no base.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A march that fails.
    #[error(transparent)]
    Run(#[from] RunError),
    /// What the model refuses.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// Times that make no sense.
    #[error(transparent)]
    Grid(#[from] GridError),
}
