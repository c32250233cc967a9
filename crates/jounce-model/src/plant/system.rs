//! Input of the solvers: modes, loads, stops and drives with resolved names.

use super::{Bridge, Signal};
use crate::contact::Law;
use crate::structure::Modes;
use jounce_spec::Wiring;
use std::sync::Arc;

/// A harvester after assembly.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct System {
    /// Modes of the structure; copies of a system share them.
    pub modes: Arc<Modes>,
    /// Electrical loads. A patch without a load is open.
    pub loads: Vec<Load>,
    /// Rectified circuits.
    pub bridges: Vec<Bridge>,
    /// Viscous friction of points.
    pub dashpots: Vec<Dashpot>,
    /// Stops.
    pub stops: Vec<Stop>,
    /// Sinusoidal drives.
    pub drives: Vec<Drive>,
    /// Drives of any other waveform.
    pub signals: Vec<Signal>,
}

/// A linear load across one patch or several: a resistor, optionally with an inductor.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Name of the circuit.
    pub name: String,
    /// Patches and their connection.
    pub connections: Vec<Connection>,
    /// Connection of several patches.
    pub wiring: Wiring,
    /// Resistance, ohm.
    pub resistance_ohm: f64,
    /// Inductance, H, and the connection of the inductor relative to the resistor.
    pub inductor: Option<(f64, Wiring)>,
}

/// A patch in a circuit.
#[derive(Debug, Clone, PartialEq)]
pub struct Connection {
    /// Name of the patch.
    pub patch: String,
    /// `-1` for reversed polarity, else `1`.
    pub sign: f64,
}

impl Load {
    /// Returns a resistor across one patch.
    pub fn resistor(name: &str, patch: &str, resistance_ohm: f64) -> Self {
        let connections = vec![Connection {
            patch: patch.to_owned(),
            sign: 1.0,
        }];
        Self {
            name: name.to_owned(),
            connections,
            wiring: Wiring::Parallel,
            resistance_ohm,
            inductor: None,
        }
    }
}

/// Viscous friction of a point on the ground: the force is `-n_s_m` times its velocity.
#[derive(Debug, Clone, PartialEq)]
pub struct Dashpot {
    /// Name of the braked body.
    pub name: String,
    /// Displacement of the point per unit modal coordinate, kg^-1/2.
    pub shape: Vec<f64>,
    /// Force over velocity, N s/m.
    pub n_s_m: f64,
}

impl Dashpot {
    /// Returns its contribution to the damping of two modes, `c s_i s_j`, 1/s.
    pub fn damping_per_s(&self, i: usize, j: usize) -> f64 {
        self.n_s_m * self.shape[i] * self.shape[j]
    }
}

/// A stop: penetration is `shape . q - gap`, plus the effect of the motions of two bases on the
/// gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// Name of the stop.
    pub name: String,
    /// Relative displacement of the striking point towards the stop, per unit modal coordinate,
    /// kg^-1/2.
    pub shape: Vec<f64>,
    /// Gap, m; negative when the contact is preloaded.
    pub gap_m: f64,
    /// Contact law.
    pub law: Law,
    /// For a stop between two bases: displacement towards the stop per displacement of each base, 1
    /// or -1.
    pub bases: Vec<(String, f64)>,
}

/// A force `amplitude sin(2 pi frequency t + phase)`. A base acceleration of 1 m/s^2 acts like a
/// force of 1 N whose `shape` is minus the participation of the modes over 1 kg.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Name of the drive.
    pub name: String,
    /// Displacement of the driven point per unit modal coordinate, kg^-1/2.
    pub shape: Vec<f64>,
    /// Amplitude, N, zero to peak.
    pub amplitude_n: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Angle at `t = 0`, rad.
    pub phase_rad: f64,
    /// Accelerated base.
    pub base: Option<String>,
}

impl System {
    /// Returns the first part that makes every response aperiodic: a drive that is not periodic, or
    /// a regulator, which switches at its own times.
    pub fn aperiodic(&self) -> Option<String> {
        let part = |signal: &Signal| match signal.drawn_from {
            Some(_) => Some(format!("regulator `{}`", signal.name)),
            None if signal.wave.is_constant() => None,
            None => Some(format!("drive `{}`", signal.name)),
        };
        self.signals.iter().find_map(part)
    }
}
