//! Acceleration of a port towards its stop without contact force, and the roundoff of its terms.

use crate::flow::state::dot;
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::ports::phasor::Phasor;
use crate::ports::state::{PortState, RigidRows};
use jounce_linalg::c64;
use jounce_simd::{F64x8, Portable};

/// Fraction of the terms of an acceleration that is roundoff.
const ACCELERATION_ROUNDOFF: f64 = 1e-12;

/// Size, in roundoffs of its terms, below which a distance or speed cannot be distinguished from
/// zero.
pub(crate) const RESOLVED_ROUNDOFFS: f64 = 4.0;

impl Integrator<'_> {
    /// True where the motion presses a touching point onto its stop.
    pub(super) fn is_pressed(&self, p: usize) -> bool {
        self.presses(p, self.pressing_acceleration_m_s2(p))
    }

    /// True where an acceleration towards the stop presses a touching point: at present, or, where
    /// it is roundoff or changes its sign within the shortest step, in the next moment.
    pub(crate) fn presses(&self, p: usize, acceleration_m_s2: f64) -> bool {
        let roundoff_m_s2 = self.acceleration_roundoff_m_s2(p);
        if acceleration_m_s2 > roundoff_m_s2 {
            return true;
        }
        let jerk_m_s3 = self.jerk_m_s3(p) - self.jerk_by_stops_m_s3(p);
        let next_m_s2 = acceleration_m_s2 + jerk_m_s3 * Kernel::length_s(Kernel::finest());
        jerk_m_s3 > 0.0 && next_m_s2 >= -roundoff_m_s2
    }

    /// Returns the magnitude below which the acceleration towards the stop is roundoff, m/s^2.
    pub(crate) fn acceleration_roundoff_m_s2(&self, p: usize) -> f64 {
        let free = self.terms_of(&self.rigid_rows(p).acceleration);
        let size =
            |tone: &Phasor| tone.displacement_m[p].norm() * tone.angular_frequency_rad_s.powi(2);
        ACCELERATION_ROUNDOFF
            * (free
                + self.tones.iter().map(size).sum::<f64>()
                + self.excitation.acceleration_after(p, 0.0).abs())
    }

    /// Returns the rate of the acceleration towards the stop without contact force, m/s^3.
    fn jerk_m_s3(&self, p: usize) -> f64 {
        let of = |tone: &Phasor| {
            let w = tone.angular_frequency_rad_s;
            acceleration(tone.displacement_m[p] * tone.turn * c64::new(0.0, w), w)
        };
        // The displacement forced by signals is a cubic: a difference is its exact rate.
        let after_s = 1.0 / self.kernel.fastest_rad_s;
        let forced = (self.excitation.acceleration_after(p, after_s)
            - self.excitation.acceleration_after(p, 0.0))
            / after_s;
        let free = dot(Portable::new(), &self.rigid_rows(p).jerk, &self.y);
        free + self.tones.iter().map(of).sum::<f64>() + forced
    }

    /// Returns the relative acceleration towards the stop without contact force, m/s^2.
    pub(crate) fn acceleration_m_s2(&self, p: usize) -> f64 {
        let drive: f64 = self
            .tones
            .iter()
            .map(|tone| {
                acceleration(
                    tone.displacement_m[p] * tone.turn,
                    tone.angular_frequency_rad_s,
                )
            })
            .sum();
        let free = dot(Portable::new(), &self.rigid_rows(p).acceleration, &self.y);
        free + drive + self.excitation.acceleration_after(p, 0.0)
    }

    /// Returns the rows and columns of a port for impacts and sticking.
    fn rigid_rows(&self, p: usize) -> &RigidRows {
        self.ports[p].rows.rigid(self.kernel, p)
    }

    /// Returns the scale for speed errors of a sticking port: the largest impact speed, or the
    /// terms of its velocity. The latter are needed where bodies push each other from rest without
    /// any impact.
    pub(crate) fn speed_m_s(&self, p: usize) -> f64 {
        self.ports[p]
            .impact_velocity_m_s
            .max(self.velocity_terms_m_s(p))
    }

    /// Returns the roundoff of the distance of a port from its stop, m.
    pub(crate) fn distance_roundoff_m(&self, p: usize) -> f64 {
        let PortState { rows, gap_m, .. } = &self.ports[p];
        f64::EPSILON
            * self
                .terms_of(&rows.displacement)
                .max(rows.tone_scale_m)
                .max(gap_m.abs())
    }

    /// Returns the sum of the magnitudes of the terms of the velocity of a port, m/s.
    pub(crate) fn velocity_terms_m_s(&self, p: usize) -> f64 {
        self.terms_of(&self.ports[p].rows.velocity)
    }

    /// Returns the sum of the magnitudes of the terms of an output.
    pub(crate) fn terms_of(&self, row: &[F64x8]) -> f64 {
        let mut sums = F64x8::ZERO;
        for (row, y) in row.iter().zip(&self.y) {
            for (sum, (row, y)) in sums.0.iter_mut().zip(row.0.iter().zip(y.0)) {
                *sum += (row * y).abs();
            }
        }
        sums.0.iter().sum()
    }
}

/// Returns the acceleration of a sinusoidal displacement, m/s^2.
pub(crate) fn acceleration(displacement_m: c64, angular_frequency_rad_s: f64) -> f64 {
    -(displacement_m * angular_frequency_rad_s * angular_frequency_rad_s).re
}
