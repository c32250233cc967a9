//! Contact: collocation of the scalar contact force, step by step, until the point leaves the stop.
//!
//! On a step the penetration at the nodes is `delta = free + D f` with the Duhamel weights `D` of
//! the table, and the force is `f = F(delta, delta')`. `D` is a double integration, so the
//! fixed-point iteration converges factorially. The force of a Hertz contact starts like `t^1.5`,
//! and so does the basis of the first step (see [`crate::force_response::basis`]). The error is
//! estimated at the two ends of the step, where the force in the basis need not match the law.

use crate::force_response::basis::BasisFunctions;
use crate::integrator::Integrator;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::phasor::PhasorSamples;
use crate::tables::contact::ContactTable;
use jounce_linalg::c64;
use jounce_model::contact::ContactLaw;
use jounce_simd::{F64x8, Simd};

/// Next contact step of a port: its tables and the drive over it.
pub(crate) struct ContactStep<'a> {
    pub(crate) port: usize,
    pub(crate) table: &'a ContactTable,
    pub(crate) basis: &'a BasisFunctions,
    pub(crate) shape: ForceBasis,
    /// Contribution of the drive to the free displacement at the nodes and the end, minus the gap.
    pub(crate) drive: F64x8,
    /// Contribution of the drive to the velocity.
    pub(crate) drive_rate: F64x8,
    /// Penetration at the start, m.
    pub(crate) start_m: f64,
    /// Its rate, m/s.
    pub(crate) start_rate_m_s: f64,
    /// Roundoff of the penetration, m.
    pub(crate) roundoff_m: f64,
}

/// Solved step: nodal penetrations, rates and forces (last lane: end of the step).
pub(crate) struct SolvedStep {
    pub(crate) penetration: F64x8,
    pub(crate) rate: F64x8,
    pub(crate) force: F64x8,
    /// Estimated error of the impulse, N s.
    pub(crate) error_n_s: f64,
}

impl<'k> Integrator<'k> {
    #[inline(always)]
    pub(crate) fn step_in_contact<'a, W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        (table, port): (&'a ContactTable, usize),
        shape: ForceBasis,
        level: i32,
        landing: bool,
    ) -> ContactStep<'a>
    where
        'k: 'a,
    {
        let kernel: &'k Kernel = self.kernel;
        let basis = kernel.basis(port, shape);
        let (mut drive, mut drive_rate) = (w.splat(-self.ports[port].gap_m), w.zero());
        for tone in &mut self.tones {
            let frequency = tone.angular_frequency_rad_s;
            let z = tone.displacement_m[port] * tone.turn;
            if landing {
                tone.samples[port] = PhasorSamples::over(frequency, basis, table.length_s);
            } else {
                tone.swing_over(kernel, port, shape, level);
            }
            drive = tone.samples[port].real(w, z, drive);
            if law.is_rate_dependent() {
                drive_rate = tone.samples[port].real(w, z * c64::new(0.0, frequency), drive_rate);
            }
        }
        [drive, drive_rate] = self.excitation.motions(
            w,
            port,
            &basis.positions,
            table.length_s,
            [drive, drive_rate],
        );
        ContactStep {
            port,
            table,
            basis,
            shape,
            drive: w.store(drive),
            drive_rate: w.store(drive_rate),
            start_m: self.ports[port].penetration_m,
            start_rate_m_s: self.ports[port].rate_m_s,
            roundoff_m: self.distance_roundoff_m(port),
        }
    }
}
