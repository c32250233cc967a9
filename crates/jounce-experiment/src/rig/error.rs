//! Errors of a virtual test.

use jounce_analysis::run::RunError;
use jounce_model::plant::PlantError;
use jounce_spec::RecordingError;

use jounce_data::recording::GridError;

/// Error of a test that cannot be simulated.
#[derive(Debug, thiserror::Error)]
pub enum RigError {
    /// A number is out of its range.
    #[error("{name} is {value}; it must be {allowed}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// Value.
        value: f64,
        /// Allowed range.
        allowed: &'static str,
    },
    /// A mode has no damping.
    #[error(
        "the mode at {frequency_hz} Hz has no damping: its response to a hit never decays; give \
        it a damping ratio, or hold the body that moves"
    )]
    Undamped {
        /// Frequency, Hz.
        frequency_hz: f64,
    },
    /// The padded record is too long.
    #[error(
        "{samples} samples are needed until the slowest mode has decayed, more than {most}; lower \
        the rate or raise the damping"
    )]
    Long {
        /// Samples needed.
        samples: f64,
        /// Maximum number of samples.
        most: usize,
    },
    /// Several bases move against each other, but only the ground can be moved.
    #[error(
        "{what} moves the ground, but the spec also has the base `{base}`: put all parts on the \
        ground, or shake `{base}` by a drive of the spec"
    )]
    Bases {
        /// First of the other bases.
        base: String,
        /// Input that moves only the ground.
        what: &'static str,
    },
    /// The point does not exist.
    #[error("there is no point `{point}` for an accelerometer; there are {known}")]
    UnknownPoint {
        /// Requested point.
        point: String,
        /// Existing points.
        known: String,
    },
    /// The recording cannot drive the base.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The run failed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Error of the plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The times are invalid.
    #[error(transparent)]
    Grid(#[from] GridError),
}
