//! `[drive.NAME]`

mod base;
mod signal;

pub use base::GROUND;
pub use signal::{DriveSignal, FrequencySweep};

/// Excitation of the harvester.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// `at`: point or mass on which a force acts, or the base that moves; empty for the ground (see
    /// [`Drive::base`]).
    pub at: String,
    /// `kind`; default `force`.
    pub kind: DriveKind,
    /// `signal` and its numbers; default `sine`.
    pub signal: DriveSignal,
}

/// Prescribed quantity of a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DriveKind {
    /// `"force"`: a force on a point, N.
    #[default]
    Force,
    /// `"base-acceleration"`: acceleration of a base with all elements on it, m/s^2. Their
    /// displacements are relative to the base.
    BaseAcceleration,
    /// `"base-displacement"`: displacement of a base, m: sinusoids, chirps and half-sines.
    /// Displacements of elements on the base are relative to it.
    BaseDisplacement,
}

impl Drive {
    /// Returns the frequency of a sinusoid, Hz.
    pub fn frequency_hz(&self) -> Option<f64> {
        if let DriveSignal::Sine { frequency_hz, .. } = self.signal {
            Some(frequency_hz)
        } else {
            None
        }
    }
}
