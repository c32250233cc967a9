//! `[drive.NAME]`

use super::DriveSignal;

/// What shakes the harvester.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// `at`: point or mass on which a force acts; empty for motions of the base.
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
    /// `"base-acceleration"`: acceleration of the ground with everything that stands on it, m/s^2. Displacements are relative to it.
    BaseAcceleration,
    /// `"base-displacement"`: displacement of the ground, m; sinusoids only. Displacements are relative to it.
    BaseDisplacement,
}

impl Drive {
    /// Frequency of a sinusoid, Hz.
    pub fn frequency_hz(&self) -> Option<f64> {
        if let DriveSignal::Sine { frequency_hz, .. } = self.signal { Some(frequency_hz) } else { None }
    }
}
