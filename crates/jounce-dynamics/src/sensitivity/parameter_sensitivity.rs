//! Ports at a fixed state: their motion under the drive, and their derivatives by a parameter.

use super::variational_integration::VariationalIntegration;
use crate::kernel::ForceBasis;
use crate::ports::phasor::PhasorSamples;
use crate::record::trajectory::TrajectorySegment;
use crate::tables::joint::StepLength;
use jounce_linalg::c64;
use jounce_model::plant::Plant;
use jounce_simd::{F64x8, Simd};

/// Derivatives by a parameter at a fixed state `y`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParameterSensitivity {
    /// For each tone, the change of the complex displacement of each port (m) and of the angular
    /// frequency (rad/s).
    pub tones: Vec<(Vec<c64>, f64)>,
    /// Change of the gap of each port, m; zero for omitted ports.
    pub gap_m: Vec<f64>,
    /// Change of the contact force of each port, relative to it; zero for omitted ports.
    pub force_relative: Vec<f64>,
}

/// Contribution of the drives to the motion of the port at a time, and its derivative by the
/// parameter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct DrivenMotion {
    pub displacement_m: f64,
    pub velocity_m_s: f64,
    pub acceleration_m_s2: f64,
    /// Derivative of the penetration by the parameter, m.
    pub penetration_drift_m: f64,
    /// Derivative of the rate by the parameter, m/s.
    pub rate_drift_m_s: f64,
}

/// Contribution of the drives to the motion at the nodes of a step and at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DrivenNodeMotion {
    pub displacement_m: F64x8,
    pub velocity_m_s: F64x8,
    pub acceleration_m_s2: F64x8,
    pub penetration_drift_m: F64x8,
    pub rate_drift_m_s: F64x8,
}

impl VariationalIntegration<'_, '_> {
    /// Evaluates a port under the drives along a step, of a level or of any length.
    #[inline(always)]
    pub(super) fn driven<W: Simd>(
        &mut self,
        w: W,
        (port, shape): (usize, ForceBasis),
        length: StepLength,
        segment: &TrajectorySegment,
    ) -> DrivenNodeMotion {
        let kernel = self.kernel;
        let basis = kernel.basis(port, shape);
        let time_s = w.fma(
            w.splat(segment.length_s),
            w.load(&F64x8(basis.positions)),
            w.splat(segment.start_s),
        );
        let (mut displacement, mut velocity, mut acceleration) = (w.zero(), w.zero(), w.zero());
        let (mut penetration_drift, mut rate_drift) = (w.splat(-self.drift.gap_of(port)), w.zero());
        for (k, tone) in self.tones.iter_mut().enumerate() {
            let frequency = tone.angular_frequency_rad_s;
            tone.set(segment.start_s);
            if length.is_level() {
                tone.swing_over(kernel, port, shape, length.level);
            } else {
                tone.samples[port] = PhasorSamples::over(frequency, basis, length.seconds());
            }
            let (samples, i) = (tone.samples[port], c64::new(0.0, 1.0));
            let z = tone.displacement_m[port] * tone.turn;
            displacement = samples.real(w, z, displacement);
            velocity = samples.real(w, z * i * frequency, velocity);
            acceleration = samples.real(w, -z * frequency * frequency, acceleration);
            if let Some((ds, dw)) = self.drift.tone_of(k, port) {
                let change = ds * tone.turn;
                let later = w.mul(w.splat(dw), time_s);
                penetration_drift = samples.real(
                    w,
                    change,
                    w.fma(later, samples.real(w, z * i, w.zero()), penetration_drift),
                );
                rate_drift = samples.real(w, change * i * frequency + z * i * dw, rate_drift);
                rate_drift = w.fma(later, samples.real(w, -z * frequency, w.zero()), rate_drift);
            }
        }
        DrivenNodeMotion {
            displacement_m: w.store(displacement),
            velocity_m_s: w.store(velocity),
            acceleration_m_s2: w.store(acceleration),
            penetration_drift_m: w.store(penetration_drift),
            rate_drift_m_s: w.store(rate_drift),
        }
    }
}

impl ParameterSensitivity {
    /// Returns the change of the complex displacement of a port under a tone (m) and of the angular
    /// frequency of the tone (rad/s).
    pub fn tone_of(&self, tone: usize, port: usize) -> Option<(c64, f64)> {
        self.tones.get(tone).map(|(displaced_m, frequency)| {
            (
                displaced_m.get(port).copied().unwrap_or_default(),
                *frequency,
            )
        })
    }

    /// Returns the change of the gap of a port, m.
    pub fn gap_of(&self, port: usize) -> f64 {
        self.gap_m.get(port).copied().unwrap_or(0.0)
    }

    /// Returns the change of the contact force of a port, relative to it.
    pub fn force_relative_of(&self, port: usize) -> f64 {
        self.force_relative.get(port).copied().unwrap_or(0.0)
    }

    /// Evaluates a port under the drives of a plant.
    pub(super) fn driven(&self, plant: &Plant, port: usize, time_s: f64) -> DrivenMotion {
        let mut driven = DrivenMotion {
            penetration_drift_m: -self.gap_of(port),
            ..DrivenMotion::default()
        };
        for (k, (tone, s)) in plant
            .tones
            .iter()
            .zip(&plant.ports[port].steady_m)
            .enumerate()
        {
            let w = tone.angular_frequency_rad_s;
            let turn = c64::cis(w * time_s);
            let phasor = s * turn;
            driven.displacement_m += phasor.re;
            driven.velocity_m_s -= w * phasor.im;
            driven.acceleration_m_s2 -= w * w * phasor.re;
            if let Some((ds, dw)) = self.tone_of(k, port) {
                let change = ds + s * c64::new(0.0, time_s * dw);
                let phase_rate_change = change * c64::new(0.0, w) + s * c64::new(0.0, dw);
                driven.penetration_drift_m += (change * turn).re;
                driven.rate_drift_m_s += (phase_rate_change * turn).re;
            }
        }
        driven
    }
}
