//! Contact: collocation of the scalar contact force, step by step, until the point leaves the stop.
//!
//! On a step the penetration at the nodes is `delta = free + D f` with the Duhamel weights `D` of
//! the table, and the force is `f = F(delta, delta')`. `D` is a double integration, so the
//! fixed-point iteration converges factorially. The force of a Hertz contact starts like `t^1.5`,
//! and so does the basis of the first step (see [`crate::force_response::basis`]). The error is
//! estimated at the two ends of the step, where the force in the basis need not match the law.

use super::peak::interpolated_peak;
use crate::flow::row::FlowRow;
use crate::flow::state::{add_force_response, add_spread_response, columns, dot, spread};
use crate::force_response::basis::{BasisFunctions, NODES, SMOOTH_BASIS};
use crate::integrator::Integrator;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::phasor::PhasorSamples;
use crate::ports::state::ContactState;
use crate::record::trajectory::PortForce;
use crate::tables::contact::ContactTable;
use faer::c64;
use jounce_model::contact::ContactLaw;
use jounce_simd::{F64x8, Simd};

/// Largest number of fixed-point iterations of a step; beyond it a shorter step is cheaper.
pub(crate) const MAX_FIXED_POINT_ITERATIONS: u32 = 24;

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
}

impl<'a> ContactStep<'a> {
    /// Creates a step with a prescribed force.
    pub(crate) fn with_prescribed_force(port: usize, table: &'a ContactTable) -> Self {
        Self {
            port,
            table,
            basis: &SMOOTH_BASIS,
            shape: ForceBasis::Smooth,
            drive: F64x8::ZERO,
            drive_rate: F64x8::ZERO,
        }
    }
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
        let (mut drive, mut drive_rate) = (w.splat(-self.ports[port].rows.gap_m), w.zero());
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
        }
    }

    /// Solves one step for its nodal forces; `None` when the fixed-point iteration does not
    /// converge.
    #[inline(always)]
    pub(crate) fn solve<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
    ) -> Option<SolvedStep> {
        let table = step.table;
        let free = columns(
            w,
            &self.layout,
            &self.y,
            &table.displacement.columns,
            w.load(&step.drive),
        );
        let mut free_rate = w.zero();
        if law.is_rate_dependent() {
            free_rate = columns(
                w,
                &self.layout,
                &self.y,
                &table.velocity.columns,
                w.load(&step.drive_rate),
            );
        }
        let port = &self.ports[step.port];
        let at_start = law.force_n(port.penetration_m, port.rate_m_s);
        let slopes = law.slopes(port.penetration_m, port.rate_m_s);
        // First guess: linear continuation of the force.
        let rise = slopes.stiffness_n_m * port.rate_m_s * table.length_s;
        let mut penetration = w.fma(
            w.splat(at_start),
            w.load(&table.constant),
            w.fma(w.splat(rise), w.load(&table.ramp), free),
        );
        let mut rate = free_rate;
        let mut force = law.forces_n(w, penetration, rate);
        let mut last = force;
        let target = (0.1 * self.tolerance).clamp(4e-15, 1e-5);
        let deepest_at_start = largest(w, law, penetration);
        // Neighbouring steps need the same number of iterations: convergence is not tested before.
        let expected = self.ports[step.port].iterations;
        let mut iteration = 0;
        while iteration < MAX_FIXED_POINT_ITERATIONS {
            iteration += 1;
            let last_but_one = std::mem::replace(&mut last, force);
            let nodal = w.store(force);
            penetration = add_force_response(w, free, &table.displacement.push, &nodal);
            if law.is_rate_dependent() {
                rate = add_force_response(w, free_rate, &table.velocity.push, &nodal);
            }
            force = law.forces_n(w, penetration, rate);
            if iteration < expected {
                continue;
            }
            let (change, size) = (w.largest(w.abs(w.sub(force, last))), largest(w, law, force));
            let last_change = w.largest(w.abs(w.sub(last, last_but_one)));
            // Remaining error: at most the contraction observed so far, or predicted by the slope
            // of the law.
            let slopes = law.steepest(deepest_at_start.max(largest(w, law, penetration)));
            let predicted =
                slopes.stiffness_n_m * table.reach_m_n + slopes.damping_n_s_m * table.reach_m_n_s;
            let contraction = if iteration == 1 {
                1.0
            } else {
                (change / last_change).min(1.0)
            };
            if change * predicted.min(contraction) <= target * size {
                // The last iteration was not needed if it changed this little.
                let spare = u32::from(change <= target * size);
                self.ports[step.port].iterations = (iteration - spare).max(1);
                self.work.iterations += u64::from(iteration);
                // Motion and force must match: the energy balance would show the error of one
                // iteration.
                let nodal = w.store(force);
                penetration = add_force_response(w, free, &table.displacement.push, &nodal);
                if law.is_rate_dependent() {
                    rate = add_force_response(w, free_rate, &table.velocity.push, &nodal);
                }
                return Some(judge(w, law, step, [penetration, rate, force], at_start));
            }
            if iteration > 4 && change > last_change {
                break;
            }
        }
        self.ports[step.port].iterations = 1;
        self.work.iterations += u64::from(iteration);
        None
    }

    /// Accepts a solved step.
    #[inline(always)]
    pub(super) fn accept_step<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        solved: &SolvedStep,
    ) {
        let table = step.table;
        let mut force = solved.force;
        force.0[NODES] = 0.0;
        if self.record.is_some() {
            self.note(table.length_s, &[PortForce::new(step, &force)]);
        }
        table.flow.apply(w, &self.y, &mut self.next);
        self.push_on(w, step, &force);
        self.integrate_force(w, step, &force);
        std::mem::swap(&mut self.y, &mut self.next);
        self.time_s += table.length_s;
        self.excitation
            .pass(self.kernel, table.length_s, self.time_s, &mut self.y);
        for tone in &mut self.tones {
            tone.turn *= tone.samples[step.port].end();
        }
        self.update_port_in_contact(w, law, step, solved);
        self.work.contact_steps += 1;
    }

    /// Sets a port to its state at the end of an accepted step.
    #[inline(always)]
    pub(crate) fn update_port_in_contact<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        solved: &SolvedStep,
    ) {
        let p = step.port;
        let speed = self.excitation.motion_after(p, 0.0)[1]
            + self.tones.iter().map(|tone| tone.motion(p)[1]).sum::<f64>();
        let started = (self.ports[p].penetration_m, self.ports[p].rate_m_s);
        let rate_m_s = dot(w, &self.ports[p].rows.velocity, &self.y) + speed;
        self.set_motion(p, [solved.penetration.0[NODES], rate_m_s]);
        self.observe(w, law, step, solved, started);
        let port = &mut self.ports[p];
        if law.acts_on_both_sides() {
            port.impact_velocity_m_s = port.impact_velocity_m_s.max(port.rate_m_s.abs());
        } else if port.penetration_m < 0.0 {
            port.regime = ContactState::Flight;
        }
    }

    /// Adds the step to the statistics.
    #[inline(always)]
    fn observe<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        solved: &SolvedStep,
        started: (f64, f64),
    ) {
        let (length_s, weights) = (step.table.length_s, &step.basis.weights);
        let port = &mut self.ports[step.port];
        let (end_m, end_m_s) = (port.penetration_m, port.rate_m_s);
        let has_separated = !law.acts_on_both_sides() && end_m < 0.0;
        // A point that has left the stop has continued at its last speed.
        let since_s = if has_separated && end_m_s < 0.0 {
            (end_m / end_m_s).min(length_s)
        } else {
            0.0
        };
        port.stay(length_s - since_s);
        let statistics = &mut port.statistics;
        // With two sides, the side of this step.
        let side = if law.acts_on_both_sides() {
            (started.0 + end_m).signum()
        } else {
            1.0
        };
        let depth = w.mul(w.splat(side), w.load(&solved.penetration));
        let highest = w.largest(depth).max(side * started.0);
        if highest > 0.98 * statistics.max_penetration_m {
            let turns =
                step.shape == ForceBasis::Smooth && side * started.1 > 0.0 && side * end_m_s < 0.0;
            let peak = if turns {
                interpolated_peak(side * started.0, &w.store(depth))
            } else {
                highest
            };
            if peak > statistics.max_penetration_m {
                statistics.max_penetration_m = peak;
                if !law.is_rate_dependent() {
                    statistics.max_force_n = statistics
                        .max_force_n
                        .max(law.force_n(side * peak, 0.0).abs());
                }
            }
        }
        if law.is_rate_dependent() {
            statistics.max_force_n = statistics.max_force_n.max(w.largest(w.load(&solved.force)));
            // Work done on the stop minus its stored energy: the elastic force itself has a kink
            // where a contact with loss is left.
            let work: f64 = (0..NODES)
                .map(|j| length_s * weights.0[j] * solved.force.0[j] * solved.rate.0[j])
                .sum();
            self.integrals.loss_j += work + law.energy_j(started.0) - law.energy_j(end_m);
        }
    }

    /// Adds the effect of the nodal forces of a step, last lane 0, on the state at its end to
    /// `next`.
    #[inline(always)]
    pub(crate) fn push_on<W: Simd>(&mut self, w: W, step: &ContactStep, force: &F64x8) {
        let column = &self.kernel.vectors[step.port].column;
        step.table
            .duhamel
            .act(w, column, force, &mut self.next, &mut self.from_start);
    }

    /// Adds the nodal forces of a step to the integrals that the energy meters need.
    #[inline(always)]
    pub(crate) fn integrate_force<W: Simd>(&mut self, w: W, step: &ContactStep, force: &F64x8) {
        let (table, basis, p) = (step.table, step.basis, step.port);
        let vectors = &self.kernel.vectors[p];
        let spread = spread(w, force);
        let motion = (self.from_start.as_slice(), self.y.as_slice());
        for ((sum, row), push) in self
            .integrals
            .loads_j
            .iter_mut()
            .zip(&vectors.loads)
            .zip(&table.loads)
        {
            *sum += metered_j(
                w,
                row,
                motion,
                add_spread_response(w, w.zero(), push, &spread),
                force,
            );
        }
        let response = add_spread_response(w, w.zero(), &table.damping, &spread);
        self.integrals.damping_j += metered_j(w, &vectors.damping, motion, response, force);
        let weighted = w.mul(
            w.mul(w.splat(table.length_s), w.load(&basis.weights)),
            w.load(force),
        );
        self.ports[p].statistics.impulse_n_s += w.sum(weighted);
        self.excitation
            .push(p, &basis.positions, table.length_s, &w.store(weighted));
        for (sum, tone) in self.integrals.tones_n_s[p].iter_mut().zip(&self.tones) {
            let (cos, sin) = (
                w.mul(weighted, w.load(&tone.samples[p].cos)),
                w.mul(weighted, w.load(&tone.samples[p].sin)),
            );
            *sum += tone.turn * c64::new(w.sum(cos), w.sum(sin));
        }
    }
}

/// Returns the meter reading of the nodal forces of a step: `integral f (row . y) dt` over the free
/// motion and over the motion that they cause.
#[inline(always)]
fn metered_j<W: Simd>(
    w: W,
    row: &FlowRow,
    (from_start, y): (&[F64x8], &[F64x8]),
    response: W::Register,
    force: &F64x8,
) -> f64 {
    w.sum(w.fma(response, w.load(force), row.read(w, from_start, y)))
}

/// Estimates the error of a converged step from the mismatch of its basis and the law at both of
/// its ends.
///
/// Penetration, rate and force hold the nodes and the end; `at_start` is the force of the law at
/// the start, N.
#[inline(always)]
pub(crate) fn judge<W: Simd, L: ContactLaw>(
    w: W,
    law: L,
    step: &ContactStep,
    [penetration, rate, force]: [W::Register; 3],
    at_start: f64,
) -> SolvedStep {
    let by_basis = |at: &F64x8| w.sum(w.mul(w.load(at), force));
    let (start, end) = (by_basis(&step.basis.at_start), by_basis(&step.basis.at_end));
    let size = at_start.abs().max(w.largest(w.abs(force)));
    let (penetration, rate, force) = (w.store(penetration), w.store(rate), w.store(force));
    let at_end = law.force_n(penetration.0[NODES], rate.0[NODES]);
    let mismatch = (start - at_start).abs().max((end - at_end).abs());
    // Gauss weights double the order of the interpolation for smooth forces and gain less at a
    // kink: 3/2 lies between. A force that exists at the end only has been missed completely.
    let ratio = if size > 0.0 { mismatch / size } else { 1.0 };
    let error_n_s = step.table.length_s * mismatch * ratio.sqrt().min(1.0);
    SolvedStep {
        penetration,
        rate,
        force,
        error_n_s,
    }
}

/// Returns the largest of eight values, or of their magnitudes where the law acts on both sides.
#[inline(always)]
pub(crate) fn largest<W: Simd, L: ContactLaw>(w: W, law: L, values: W::Register) -> f64 {
    w.largest(if law.acts_on_both_sides() {
        w.abs(values)
    } else {
        values
    })
}
