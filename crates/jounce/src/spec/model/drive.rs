//! `[drive.NAME]`

use super::DriveSignal;

/// What shakes the harvester.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// `at`: point or mass on which a force acts, or the base that moves: empty for the ground (see [`Drive::base`]).
    pub at: String,
    /// `kind`; default `force`.
    pub kind: DriveKind,
    /// `signal` and its numbers; default `sine`.
    pub signal: DriveSignal,
}

/// What a drive prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DriveKind {
    /// `"force"`: a force on a point, N.
    #[default]
    Force,
    /// `"base-acceleration"`: acceleration of a base with everything that stands on it, m/s^2. Displacements of that are relative to it.
    BaseAcceleration,
    /// `"base-displacement"`: displacement of a base, m: sinusoids, chirps and half-sines. Displacements of what stands on it are relative to it.
    BaseDisplacement,
}

impl Drive {
    /// Frequency of a sinusoid, Hz.
    pub fn frequency_hz(&self) -> Option<f64> {
        if let DriveSignal::Sine { frequency_hz, .. } = self.signal {
            Some(frequency_hz)
        } else {
            None
        }
    }
}
