//! Solution of a contact step by fixed-point iteration, and its error estimate.

use super::step::{ContactStep, SolvedStep};
use crate::flow::state::{add_force_response, columns};
use crate::force_response::basis::NODES;
use crate::impact::acceleration::RESOLVED_ROUNDOFFS;
use crate::integrator::Integrator;
use crate::tables::contact::ContactTable;
use jounce_model::contact::ContactLaw;
use jounce_simd::{F64x8, Simd};

/// Largest number of fixed-point iterations of a step; beyond it a shorter step is cheaper.
pub(crate) const MAX_FIXED_POINT_ITERATIONS: u32 = 24;

impl Integrator<'_> {
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
        let free = self.free_motion(w, law, step);
        let port = &self.ports[step.port];
        let at_start = law.force_n(port.penetration_m, port.rate_m_s);
        let slopes = law.slopes(port.penetration_m, port.rate_m_s);
        // First guess: linear continuation of the force.
        let rise = slopes.stiffness_n_m * port.rate_m_s * table.length_s;
        let guess = w.fma(
            w.splat(at_start),
            w.load(&table.constant),
            w.fma(w.splat(rise), w.load(&table.ramp), free[0]),
        );
        let mut force = law.forces_n(w, guess, free[1]);
        let mut last = force;
        let target = self.target_change();
        let deepest_at_start = largest(w, law, guess);
        // Neighbouring steps need the same number of iterations: convergence is not tested before.
        let expected = self.ports[step.port].iterations;
        let mut iteration = 0;
        while iteration < MAX_FIXED_POINT_ITERATIONS {
            iteration += 1;
            let last_but_one = std::mem::replace(&mut last, force);
            let [penetration, rate] = motion_under(w, law, table, free, force);
            force = law.forces_n(w, penetration, rate);
            if iteration < expected {
                continue;
            }
            let (change, size) = (w.largest(w.abs(w.sub(force, last))), largest(w, law, force));
            let last_change = w.largest(w.abs(w.sub(last, last_but_one)));
            // Remaining error: at most the contraction observed so far, or predicted by the slope
            // of the law.
            let deepest = deepest_at_start.max(largest(w, law, penetration));
            let predicted = predicted_contraction(law, table, deepest);
            let contraction = if iteration == 1 {
                1.0
            } else {
                (change / last_change).min(1.0)
            };
            // Forces that overflow have not converged.
            if size.is_finite() && change * predicted.min(contraction) <= target * size {
                // The last iteration was not needed if it changed this little.
                let spare = u32::from(change <= target * size);
                self.count_iterations(step.port, iteration, (iteration - spare).max(1));
                // Motion and force must match: the energy balance would show the error of one
                // iteration.
                let [penetration, rate] = motion_under(w, law, table, free, force);
                return Some(judge(w, law, step, [penetration, rate, force], at_start));
            }
            if diverges(iteration, change, last_change) {
                break;
            }
        }
        self.count_iterations(step.port, iteration, 1);
        None
    }

    /// Returns penetration and rate at the nodes and the end of a step without contact force; the
    /// rate is zero for a law that does not depend on it.
    #[inline(always)]
    fn free_motion<W: Simd, L: ContactLaw>(
        &self,
        w: W,
        law: L,
        step: &ContactStep,
    ) -> [W::Register; 2] {
        let (layout, table) = (&self.layout, step.table);
        let displacement = &table.displacement.columns;
        let free = columns(w, layout, &self.y, displacement, w.load(&step.drive));
        let mut free_rate = w.zero();
        if law.is_rate_dependent() {
            let velocity = &table.velocity.columns;
            free_rate = columns(w, layout, &self.y, velocity, w.load(&step.drive_rate));
        }
        [free, free_rate]
    }

    /// Counts the iterations of a step and sets the number expected for the next.
    #[inline(always)]
    fn count_iterations(&mut self, port: usize, iterations: u32, expected: u32) {
        self.ports[port].iterations = expected;
        self.work.iterations += u64::from(iterations);
    }
}

/// True where an iteration grows after its first iterations.
#[inline(always)]
pub(crate) fn diverges(iteration: u32, change_n: f64, last_change_n: f64) -> bool {
    iteration > 4 && change_n > last_change_n
}

/// Returns penetration and rate at the nodes and the end of a step under nodal forces.
#[inline(always)]
fn motion_under<W: Simd, L: ContactLaw>(
    w: W,
    law: L,
    table: &ContactTable,
    [free, free_rate]: [W::Register; 2],
    force: W::Register,
) -> [W::Register; 2] {
    let nodal = w.store(force);
    let penetration = add_force_response(w, free, &table.displacement.push, &nodal);
    let mut rate = free_rate;
    if law.is_rate_dependent() {
        rate = add_force_response(w, free_rate, &table.velocity.push, &nodal);
    }
    [penetration, rate]
}

/// Returns the contraction of one iteration that the steepest slope of the law up to a penetration
/// allows.
#[inline(always)]
fn predicted_contraction<L: ContactLaw>(law: L, table: &ContactTable, deepest_m: f64) -> f64 {
    let slopes = law.steepest(deepest_m);
    slopes.stiffness_n_m * table.reach_m_n + slopes.damping_n_s_m * table.reach_m_n_s
}

/// Estimates the error of a converged step from the mismatch of its basis and the law at both of
/// its ends.
///
/// Penetration, rate and force hold the nodes and the end; `at_start` is the force of the law at
/// the start, N. What the roundoff of the penetration does to the force of a stiff stop is no error
/// of the basis.
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
    // All nodes may be off a stop that the step leaves at its start.
    let deepest_m = largest(w, law, penetration).max(step.start_m.abs());
    let (penetration, rate, mut force) = (w.store(penetration), w.store(rate), w.store(force));
    // Newton's method solves for the nodal forces only.
    let at_end = law.force_n(penetration.0[NODES], rate.0[NODES]);
    force.0[NODES] = at_end;
    let size = at_start.abs().max(w.largest(w.abs(w.load(&force))));
    let secant_n_m = size / deepest_m.max(f64::MIN_POSITIVE);
    let roundoff_n = RESOLVED_ROUNDOFFS * step.roundoff_m * secant_n_m;
    let mismatch = ((start - at_start).abs().max((end - at_end).abs()) - roundoff_n).max(0.0);
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
