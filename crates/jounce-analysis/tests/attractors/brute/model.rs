//! Equations of motion in modal coordinates, state `(q, q', V, E)` with `E` the energy dissipated
//! in the resistor.
//!
//! ```text
//! q_i'' = -2 zeta_i w_i q_i' - w_i^2 q_i + theta_i V + p_i sin(W t + phi) + g_i - sum_stops s_i F
//! C V'  = -V / R - V / R_leak - sum theta_i q_i'
//! E'    = V^2 / R
//! ```

use super::law::{Law, Phase};
use super::record::Work;
use super::scales::Weights;
use jounce_model::drive::Wave;
use jounce_model::plant::System;
use std::f64::consts::TAU;

/// Largest number of stops.
pub const STOPS: usize = 2;

/// Phases of all contacts.
pub type Phases = [Phase; STOPS];

/// A stop.
#[derive(Debug, Clone, Copy)]
pub struct Stop<const N: usize> {
    pub shape: [f64; N],
    pub square: f64,
    pub gap: f64,
    pub law: Law,
}

impl<const N: usize> Stop<N> {
    /// Displacement and velocity of the point towards the stop.
    #[inline(always)]
    pub fn along<const D: usize>(&self, y: &[f64; D]) -> [f64; 2] {
        let (mut displacement, mut velocity) = (0.0, 0.0);
        for i in 0..N {
            displacement += self.shape[i] * y[i];
            velocity += self.shape[i] * y[N + i];
        }
        [displacement, velocity]
    }
}

/// Parameters of a harvester with up to `N` modes and at most one patch; `D = 2 N + 2`.
#[derive(Debug, Clone)]
pub struct ReferenceModel<const N: usize, const D: usize> {
    stiffness: [f64; N],
    damping: [f64; N],
    coupling: [f64; N],
    driven: [f64; N],
    steady: [f64; N],
    capacitance: f64,
    conductance: f64,
    leak: f64,
    angular: f64,
    phase: f64,
    modes: usize,
    has_patch: bool,
    pub cycle_s: f64,
    pub stops: Vec<Stop<N>>,
    pub weights: Weights<D>,
}

fn filled<const N: usize>(values: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

/// Sum of the constant forces; other signals are not covered.
fn steady_forces<const N: usize>(system: &System) -> [f64; N] {
    let mut steady = [0.0; N];
    for signal in &system.signals {
        let Wave::Constant(size) = signal.wave else {
            panic!("the drive {} is no sine", signal.name)
        };
        (0..system.modes.len()).for_each(|i| steady[i] += size * signal.shape[i]);
    }
    steady
}

impl<const N: usize, const D: usize> ReferenceModel<N, D> {
    /// Parameters of a system, which must be covered by the equations above.
    pub fn of(system: &System) -> Self {
        assert!(D == 2 * N + 2 && system.modes.len() <= N && system.stops.len() <= STOPS);
        assert!(
            system.bridges.is_empty()
                && system.dashpots.is_empty()
                && system.drives.len() == 1
                && system.modes.patch.len() <= 1
        );
        let (modes, drive) = (&system.modes, &system.drives[0]);
        let frequency: [f64; N] = filled(&modes.frequency_rad_s);
        let ratio: [f64; N] = filled(&modes.damping_ratio);
        let patch = modes.patch.values().next();
        let load = system.loads.first();
        assert!(load.is_none_or(|load| load.inductor.is_none()
            && load.connections.len() == 1
            && load.connections[0].sign == 1.0));
        let angular = TAU * drive.frequency_hz;
        let capacitance = patch.map_or(1.0, |patch| patch.capacitance_f);
        let mut weights = [0.0; D];
        for i in 0..N {
            // Unused modes stay at zero; the scale of a mode without stiffness is the drive
            // frequency.
            weights[i] = if frequency[i] > 0.0 {
                frequency[i]
            } else {
                angular
            };
            weights[N + i] = 1.0;
        }
        weights[2 * N] = capacitance.sqrt();
        Self {
            stiffness: frequency.map(|w| w * w),
            damping: std::array::from_fn(|i| 2.0 * ratio[i] * frequency[i]),
            coupling: patch.map_or([0.0; N], |patch| filled(&patch.coupling_n_per_v)),
            driven: filled(
                &drive
                    .shape
                    .iter()
                    .map(|shape| shape * drive.amplitude_n)
                    .collect::<Vec<_>>(),
            ),
            steady: steady_forces(system),
            capacitance,
            conductance: load.map_or(0.0, |load| load.resistance_ohm.recip()),
            leak: patch
                .and_then(|patch| patch.leakage_ohm)
                .map_or(0.0, f64::recip),
            angular,
            phase: drive.phase_rad,
            modes: modes.len(),
            has_patch: patch.is_some(),
            cycle_s: drive.frequency_hz.recip(),
            stops: system.stops.iter().map(stop).collect(),
            weights: Weights(weights),
        }
    }

    /// Converts a physical state `(q, q', V)`, with zero energy in the meter.
    pub fn state(&self, physical: &[f64]) -> [f64; D] {
        let n = self.modes;
        let mut y = [0.0; D];
        y[..n].copy_from_slice(&physical[..n]);
        y[N..N + n].copy_from_slice(&physical[n..2 * n]);
        y[2 * N] = if self.has_patch { physical[2 * n] } else { 0.0 };
        y
    }

    /// Converts to energy coordinates `(w q, q', sqrt(C) V)`, without components that the harvester
    /// lacks.
    pub fn energy_coordinates(&self, y: &[f64; D]) -> Vec<f64> {
        let scaled = self.weights.scaled(y);
        let n = self.modes;
        let voltage = scaled[2 * N..].iter().take(usize::from(self.has_patch));
        scaled[..n]
            .iter()
            .chain(&scaled[N..N + n])
            .chain(voltage)
            .copied()
            .collect()
    }

    /// Lower limit of the size of a motion: a thousandth of the velocities due to drive and gravity
    /// in a radian.
    pub fn least_size(&self) -> f64 {
        let norm = |force: &[f64; N]| force.iter().map(|p| p * p).sum::<f64>().sqrt();
        1e-3 * (norm(&self.driven) + norm(&self.steady)) / self.angular
    }

    /// Returns the phases of contacts at a start.
    #[inline(always)]
    pub fn phases(&self, y: &[f64; D]) -> Phases {
        let mut phases = [Phase::Free; STOPS];
        for (phase, stop) in phases.iter_mut().zip(&self.stops) {
            let [d, rate] = self.depth(stop, y);
            *phase = stop.law.phase(d, rate);
        }
        phases
    }

    /// Returns penetration and rate at a stop.
    #[inline(always)]
    pub fn depth(&self, stop: &Stop<N>, y: &[f64; D]) -> [f64; 2] {
        let (mut d, mut rate) = (-stop.gap, 0.0);
        for i in 0..N {
            d += stop.shape[i] * y[i];
            rate += stop.shape[i] * y[N + i];
        }
        [d, rate]
    }

    /// Rate of the state. Points that stick to a rigid stop are held there, except that of stop
    /// number `released`.
    #[inline(always)]
    pub fn rate(&self, t: f64, y: &[f64; D], phases: &Phases, released: usize) -> [f64; D] {
        let mut rate = self.linear_rate(y, self.drive_angle(t).sin(), 1.0);
        for (stop, phase) in self.stops.iter().zip(phases) {
            if *phase == Phase::Pushing {
                let [d, speed] = self.depth(stop, y);
                let force = stop.law.force(*phase, d, speed);
                (0..N).for_each(|i| rate[N + i] -= stop.shape[i] * force);
            }
        }
        for (p, stop) in self.stops.iter().enumerate() {
            if phases[p] == Phase::Resting && p != released {
                let force = self.depth(stop, &rate)[1] / stop.square;
                (0..N).for_each(|i| rate[N + i] -= stop.shape[i] * force);
            }
        }
        rate[2 * N + 1] = self.load_power(y[2 * N] * y[2 * N]);
        rate
    }

    /// Powers at a state, W: input, modal damping, leakage, and loss in the contacts.
    pub fn powers(&self, t: f64, y: &[f64; D], phases: &Phases) -> Work {
        let (drive, mut work) = (self.drive_angle(t).sin(), Work::default());
        for i in 0..N {
            let speed = y[N + i];
            work.input_j += (self.driven[i] * drive + self.steady[i]) * speed;
            work.damping_j += self.damping[i] * speed * speed;
        }
        work.leak_j = y[2 * N] * y[2 * N] * self.leak;
        for (stop, phase) in self.stops.iter().zip(phases) {
            if *phase == Phase::Pushing && stop.law.is_damped() {
                let [d, speed] = self.depth(stop, y);
                let force = stop.law.force(*phase, d, speed);
                work.contact_j += (force - stop.law.elastic(d)) * speed;
            }
        }
        work
    }

    /// Energy stored in a state, J, including that of the stops that push. That of a stop that no longer
    /// pushes is lost.
    pub fn stored(&self, y: &[f64; D], phases: &Phases) -> f64 {
        let mechanical: f64 = (0..N)
            .map(|i| y[N + i] * y[N + i] + self.stiffness[i] * y[i] * y[i])
            .sum();
        let closed = self.stops.iter().zip(phases);
        let compressed: f64 = closed
            .filter(|(_, phase)| **phase == Phase::Pushing)
            .map(|(stop, _)| stop.law.stored(self.depth(stop, y)[0]))
            .sum();
        0.5 * (mechanical + self.capacitance * y[2 * N] * y[2 * N]) + compressed
    }

    /// Angle of the drive.
    pub fn drive_angle(&self, t: f64) -> f64 {
        self.angular * t + self.phase
    }

    /// Angular frequency of the drive.
    pub fn angular(&self) -> f64 {
        self.angular
    }

    /// Power in the resistor at the square of the voltage.
    #[inline(always)]
    pub fn load_power(&self, square: f64) -> f64 {
        square * self.conductance
    }

    /// Rate without contact forces and energy, for a drive signal and a factor on the constant
    /// forces.
    #[inline(always)]
    pub fn linear_rate(&self, y: &[f64; D], drive: f64, constant: f64) -> [f64; D] {
        let mut rate = [0.0; D];
        let (voltage, mut current) = (y[2 * N], 0.0);
        for i in 0..N {
            rate[i] = y[N + i];
            let internal = self.damping[i] * y[N + i] + self.stiffness[i] * y[i];
            rate[N + i] =
                self.coupling[i] * voltage + self.driven[i] * drive + self.steady[i] * constant
                    - internal;
            current += self.coupling[i] * y[N + i];
        }
        rate[2 * N] = -(voltage * (self.conductance + self.leak) + current) / self.capacitance;
        rate
    }
}

fn stop<const N: usize>(stop: &jounce_model::plant::Stop) -> Stop<N> {
    assert!(
        stop.bases.is_empty(),
        "stop {} stands on a moving base",
        stop.name
    );
    let square = stop.shape.iter().map(|s| s * s).sum();
    Stop {
        shape: filled(&stop.shape),
        square,
        gap: stop.gap_m,
        law: Law::of(&stop.law),
    }
}
