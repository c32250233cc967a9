//! Joint solution for the nodal forces of all ports in contact.

use super::sticking::StickingPorts;
use crate::contact::solve::{MAX_FIXED_POINT_ITERATIONS, diverges, judge, largest};
use crate::contact::step::{ContactStep, SolvedStep};
use crate::flow::state::{add_force_response, columns};
use crate::integrator::Integrator;
use crate::ports::small_list::SmallList;
use crate::tables::joint::JointTables;
use jounce_model::contact::{ContactLaw, Law};
use jounce_simd::{F64x8, Simd};

/// Step of all ports in contact.
pub struct JointStep<'t, 'a> {
    /// Tables of the step.
    pub tables: &'t JointTables<'a>,
    /// Contact step of each port, in the order of the tables.
    pub steps: SmallList<ContactStep<'t>>,
}

/// Iterate of one port. Vectors hold the nodes and the end of the step.
pub struct PortIterate {
    /// Law of its stop.
    pub(super) law: Law,
    /// Motion without any contact force on the step.
    free: F64x8,
    free_rate: F64x8,
    /// Penetration, m.
    pub(super) penetration: F64x8,
    /// Its rate, m/s.
    pub(super) rate: F64x8,
    /// Nodal forces, N.
    pub force: F64x8,
    at_start_n: f64,
    deepest_m: f64,
    last_change_n: f64,
}

/// Convergence of an iteration over all ports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Convergence {
    Converged,
    GoesOn,
    Diverges,
}

impl<'k> Integrator<'k> {
    /// Prepares the step.
    #[inline(always)]
    pub(super) fn joint_step<'t, 'a, W: Simd>(
        &mut self,
        w: W,
        tables: &'t JointTables<'a>,
    ) -> JointStep<'t, 'a>
    where
        'k: 't,
    {
        w.out_of_line(
            #[inline(always)]
            || self.lay_out(w, tables),
        )
    }

    #[inline(always)]
    fn lay_out<'t, 'a, W: Simd>(&mut self, w: W, tables: &'t JointTables<'a>) -> JointStep<'t, 'a>
    where
        'k: 't,
    {
        let (level, odd) = (tables.length.level, !tables.length.is_level());
        let mut steps = SmallList::new();
        for (index, (port, shape)) in tables.ports.iter().enumerate() {
            steps.push(self.step_in_contact(
                w,
                self.law(*port),
                (tables.table(index), *port),
                *shape,
                level,
                odd,
            ));
        }
        JointStep { tables, steps }
    }

    /// Solves a step for the nodal forces of all its ports; `None` when the fixed-point iteration
    /// does not converge.
    #[inline(always)]
    pub(super) fn solve_joint<W: Simd>(
        &mut self,
        w: W,
        joint: &JointStep,
        resting: &StickingPorts,
    ) -> Option<SmallList<SolvedStep>> {
        w.out_of_line(
            #[inline(always)]
            || self.solve_all(w, joint, resting),
        )
    }

    #[inline(always)]
    fn solve_all<W: Simd>(
        &mut self,
        w: W,
        joint: &JointStep,
        resting: &StickingPorts,
    ) -> Option<SmallList<SolvedStep>> {
        let iterates = self
            .iterate(w, joint, resting)
            .or_else(|| self.newton(w, joint, resting))?;
        Some(self.judge_all(w, joint, resting, iterates))
    }

    #[inline(always)]
    fn iterate<W: Simd>(
        &mut self,
        w: W,
        joint: &JointStep,
        resting: &StickingPorts,
    ) -> Option<SmallList<PortIterate>> {
        let mut iterates = self.first_guess(w, joint);
        let target = self.target_change();
        for iteration in 1..=MAX_FIXED_POINT_ITERATIONS {
            self.work.iterations += 1;
            move_under_forces(w, joint, resting, &mut iterates);
            let mut progress = Convergence::Converged;
            for (index, iterate) in iterates.iter_mut().enumerate() {
                progress = progress.max(iterate.renew(w, joint.tables, (index, iteration), target));
            }
            match progress {
                Convergence::GoesOn => {}
                Convergence::Diverges => return None,
                Convergence::Converged => return Some(iterates),
            }
        }
        None
    }

    /// Returns the change of the forces, relative to the largest, below which an iteration has
    /// converged.
    pub(crate) fn target_change(&self) -> f64 {
        (0.1 * self.tolerance).clamp(4e-15, 1e-5)
    }

    /// Computes the motion under the final forces, and the error of the step at each port.
    #[inline(always)]
    pub(super) fn judge_all<W: Simd>(
        &self,
        w: W,
        joint: &JointStep,
        resting: &StickingPorts,
        mut iterates: SmallList<PortIterate>,
    ) -> SmallList<SolvedStep> {
        move_under_forces(w, joint, resting, &mut iterates);
        let mut solved = SmallList::<SolvedStep>::new();
        for (step, solution) in joint.steps.iter().zip(&iterates) {
            solved.push(judge(
                w,
                solution.law,
                step,
                solution.registers(w),
                solution.at_start_n,
            ));
        }
        resting.judge(self, joint, &mut solved);
        solved
    }

    /// Returns the first guess: linear continuation of the forces.
    #[inline(always)]
    pub(super) fn first_guess<W: Simd>(&self, w: W, joint: &JointStep) -> SmallList<PortIterate> {
        let mut iterates = SmallList::new();
        for step in &joint.steps {
            let (law, port, table) = (self.law(step.port), &self.ports[step.port], step.table);
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
            let at_start_n = law.force_n(port.penetration_m, port.rate_m_s);
            let rise = law.slopes(port.penetration_m, port.rate_m_s).stiffness_n_m
                * port.rate_m_s
                * table.length_s;
            let penetration = w.fma(
                w.splat(at_start_n),
                w.load(&table.constant),
                w.fma(w.splat(rise), w.load(&table.ramp), free),
            );
            iterates.push(PortIterate {
                law,
                free: w.store(free),
                free_rate: w.store(free_rate),
                penetration: w.store(penetration),
                rate: w.store(free_rate),
                force: w.store(law.forces_n(w, penetration, free_rate)),
                at_start_n,
                // Retained however far off: where the next guess leaves contact again, this shows
                // that the iteration has not converged.
                deepest_m: largest(w, law, penetration),
                last_change_n: f64::INFINITY,
            });
        }
        iterates
    }
}

/// Computes the forces of the sticking ports, and the motion of each port under the nodal forces of
/// all.
#[inline(always)]
pub(super) fn move_under_forces<W: Simd>(
    w: W,
    joint: &JointStep,
    resting: &StickingPorts,
    iterates: &mut [PortIterate],
) {
    resting.hold(iterates);
    for index in 0..iterates.len() {
        let iterate = &iterates[index];
        let needs_rate = iterate.law.is_rate_dependent();
        let (mut penetration, mut rate) = (w.load(&iterate.free), w.load(&iterate.free_rate));
        for (from, other) in iterates.iter().enumerate() {
            let [displacement, velocity] = joint.tables.responses(from, index);
            penetration = add_force_response(w, penetration, displacement, &other.force);
            if needs_rate {
                rate = add_force_response(w, rate, velocity, &other.force);
            }
        }
        (iterates[index].penetration, iterates[index].rate) = (w.store(penetration), w.store(rate));
    }
}

impl PortIterate {
    /// Returns penetration, rate and force of the iterate.
    #[inline(always)]
    fn registers<W: Simd>(&self, w: W) -> [W::Register; 3] {
        [
            w.load(&self.penetration),
            w.load(&self.rate),
            w.load(&self.force),
        ]
    }

    /// Computes new forces by the law; the forces of a sticking port are computed elsewhere.
    #[inline(always)]
    fn renew<W: Simd>(
        &mut self,
        w: W,
        tables: &JointTables,
        (index, iteration): (usize, u32),
        target: f64,
    ) -> Convergence {
        if matches!(self.law, Law::Rigid(_)) {
            return Convergence::Converged;
        }
        let penetration = w.load(&self.penetration);
        let new = self.law.forces_n(w, penetration, w.load(&self.rate));
        let (change, size) = (
            w.largest(w.abs(w.sub(new, w.load(&self.force)))),
            largest(w, self.law, new),
        );
        self.force = w.store(new);
        self.deepest_m = self.deepest_m.max(largest(w, self.law, penetration));
        // Remaining error: at most the contraction observed so far, or predicted by the slope of
        // the law.
        let slopes = self.law.steepest(self.deepest_m);
        let predicted = slopes.stiffness_n_m * tables.reach_m_n(index)
            + slopes.damping_n_s_m * tables.reach_m_n_s(index);
        let contraction = if iteration == 1 {
            1.0
        } else {
            (change / self.last_change_n).min(1.0)
        };
        let diverges = diverges(iteration, change, self.last_change_n);
        self.last_change_n = change;
        // Forces that overflow have not converged.
        if size.is_finite() && change * predicted.min(contraction) <= target * size {
            Convergence::Converged
        } else if diverges || !change.is_finite() {
            Convergence::Diverges
        } else {
            Convergence::GoesOn
        }
    }
}
