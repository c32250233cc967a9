//! Drives that are linear in time between breakpoints: gravity, recordings, noise, pulses. The current
//! that a regulator draws is such a signal too.

use crate::drive::Wave;

/// A drive of any waveform: the modal force is `shape` times the value of its wave.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// Name of the drive.
    pub name: String,
    /// Modal force per unit value. For a force, in N: displacement of the driven point per unit
    /// modal coordinate, kg^-1/2. For an acceleration of the ground, in m/s^2: the participation of
    /// each mode with its sign, kg^1/2.
    pub shape: Vec<f64>,
    /// Waveform in time.
    pub wave: Wave,
    /// Accelerated base.
    pub base: Option<String>,
    /// Index of the bridge from whose storage the signal draws a current, in A. Its value is 0
    /// until the integrator sets it.
    pub drawn_from: Option<usize>,
}
