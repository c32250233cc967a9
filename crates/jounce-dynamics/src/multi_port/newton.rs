//! Newton's method for the nodal forces of a step: a strong dashpot or a stiff spring keeps the fixed
//! point from contracting on steps that the motion allows.
//!
//! ```text
//! f_p = F_p(delta_p, delta_p'),   delta_p = free_p + sum_q D_pq f_q,   delta_p' = free_p' + sum_q V_pq f_q
//! sum_q (1 - K_p D_pq - C_p V_pq) df_q = F_p - f_p
//! ```
//!
//! `K` and `C` are the slopes of the law at each node. Let `r = F(delta) - f` be the mismatch of law
//! and polynomial on the step, which is zero at the nodes. The motion deviates from the exact one by
//! `d`, which starts from rest. For a spring on a mass `1/m`,
//!
//! ```text
//! d'' + K m d = -m r,   K |d(t)| <= |r(0)| + |r(t)| + V(r),
//! ```
//!
//! with the total variation `V(r)`. On a free mass `r` is the Legendre polynomial of the nodes times a
//! linear function, so that its values at both ends bound it. The error estimate uses these values:
//! an oscillation of the spring that the step skips would appear in them. An integration with
//! derivative must also resolve oscillations that the motion does not contain: there a spring must
//! contract on its own.

use super::joint_solve::{JointStep, PortIterate, move_under_forces};
use super::sticking::StickingPorts;
use crate::contact::solve::{MAX_FIXED_POINT_ITERATIONS, diverges, largest};
use crate::contact::step::SolvedStep;
use crate::force_response::basis::NODES;
use crate::integrator::Integrator;
use crate::kernel::ForceBasis;
use crate::ports::small_list::SmallList;
use crate::tables::joint::{JointTables, StepLength};
use jounce_linalg::{LuFactors, Mat};
use jounce_model::contact::{ContactLaw, Law, Slopes};
use jounce_simd::Simd;

impl Integrator<'_> {
    /// Solves a step of one port whose fixed point did not converge.
    #[inline(always)]
    pub(crate) fn solve_by_newton<W: Simd>(
        &mut self,
        w: W,
        port: (usize, ForceBasis),
        length: StepLength,
    ) -> Option<SolvedStep> {
        w.out_of_line(
            #[inline(always)]
            || {
                let tables = JointTables::new(self.kernel, &[port], length);
                let joint = self.joint_step(w, &tables);
                let resting = StickingPorts::new(self, &tables);
                let iterates = self.newton(w, &joint, &resting)?;
                self.judge_all(w, &joint, &resting, iterates).pop()
            },
        )
    }

    /// Returns the nodal forces by Newton's method; `None` where it does not converge, or where the
    /// step of an integration with derivative is too long for a spring.
    #[inline(always)]
    pub(super) fn newton<W: Simd>(
        &mut self,
        w: W,
        joint: &JointStep,
        resting: &StickingPorts,
    ) -> Option<SmallList<PortIterate>> {
        let mut iterates = self.first_guess(w, joint);
        let resolves_derivative = self.resolves_derivative();
        let is_damped = |iterate: &PortIterate| iterate.law.is_rate_dependent();
        if resolves_derivative && !iterates.iter().any(is_damped) {
            return None;
        }
        let (target, mut last_change_n) = (self.target_change(), f64::INFINITY);
        for iteration in 1..=MAX_FIXED_POINT_ITERATIONS {
            self.work.iterations += 1;
            move_under_forces(w, joint, resting, &mut iterates);
            let mut changes = residuals(&iterates);
            LuFactors::of(&jacobian(joint, resting, &iterates)).solve(&mut changes);
            if changes.iter().any(|change| !change.is_finite()) {
                return None;
            }
            let (mut converged, mut largest_n) = (true, 0.0_f64);
            for (iterate, changes) in iterates.iter_mut().zip(changes.chunks(NODES)) {
                for (force, change) in iterate.force.0.iter_mut().zip(changes) {
                    *force += change;
                }
                let change = changes.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
                let size = largest(w, iterate.law, w.load(&iterate.force));
                converged &= change <= target * size.max(0.0);
                largest_n = largest_n.max(change);
            }
            if converged {
                let is_resolved = !resolves_derivative || springs_contract(w, joint, &iterates);
                return is_resolved.then_some(iterates);
            }
            if diverges(iteration, largest_n, last_change_n) {
                return None;
            }
            last_change_n = largest_n;
        }
        None
    }
}

/// Returns the forces of the laws less those of the iterates; zero at sticking ports, whose forces
/// have been solved for.
fn residuals(iterates: &[PortIterate]) -> Vec<f64> {
    let residual = |iterate: &PortIterate, i: usize| match iterate.law {
        Law::Rigid(_) => 0.0,
        law => law.force_n(iterate.penetration.0[i], iterate.rate.0[i]) - iterate.force.0[i],
    };
    iterates
        .iter()
        .flat_map(|iterate| (0..NODES).map(move |i| residual(iterate, i)))
        .collect()
}

/// Returns the derivative of the residuals, with the opposite sign.
fn jacobian(joint: &JointStep, resting: &StickingPorts, iterates: &[PortIterate]) -> Mat<f64> {
    let slopes: Vec<Slopes> = iterates
        .iter()
        .flat_map(|of| (0..NODES).map(|i| of.law.slopes(of.penetration.0[i], of.rate.0[i])))
        .collect();
    let size = iterates.len() * NODES;
    Mat::from_fn(size, size, |row, column| {
        let ((to, i), (from, j)) = ((row / NODES, row % NODES), (column / NODES, column % NODES));
        if let Some(coefficient) = resting.coefficient(to, from, [i, j]) {
            return coefficient;
        }
        let [displacement, velocity] = joint.tables.responses(from, to);
        f64::from(row == column)
            - slopes[row].stiffness_n_m * displacement[j].0[i]
            - slopes[row].damping_n_s_m * velocity[j].0[i]
    })
}

/// True where the fixed point of each spring alone contracts.
#[inline(always)]
fn springs_contract<W: Simd>(w: W, joint: &JointStep, iterates: &[PortIterate]) -> bool {
    iterates.iter().enumerate().all(|(index, iterate)| {
        let deepest_m = largest(w, iterate.law, w.load(&iterate.penetration));
        let stiffness_n_m = match iterate.law {
            Law::Rigid(_) => 0.0,
            law => law.steepest(deepest_m).stiffness_n_m,
        };
        stiffness_n_m * joint.tables.reach_m_n(index) <= 1.0
    })
}
