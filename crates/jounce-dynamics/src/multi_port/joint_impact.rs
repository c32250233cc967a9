//! Simultaneous impacts on rigid stops: Newton's law for all of them.
//!
//! Points move in at speeds `v_a > 0`. With the mobilities `M_ab` (1/kg, Delassus' matrix) and the
//! restitutions `e_a` the impulses `p_a` (N s) and the speeds `u_a` after them obey
//!
//! ```text
//! u_a = v_a - sum_b M_ab p_b,    p_a >= 0,    u_a <= -e_a v_a,    p_a (u_a + e_a v_a) = 0,
//! ```
//!
//! a linear complementarity problem: a point that the others throw off faster than its own law
//! receives no impulse. The energy lost is `sum p_a (v_a + u_a) / 2 = sum p_a (1 - e_a) v_a / 2`,
//! never negative. Where the matrix is singular (stops that constrain the same motion) the smallest
//! solution is taken, so that equal stops have equal impulses.
//!
//! Source: J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988.

use super::holding::MIN_RELATIVE_MOBILITY;
use crate::integrator::Integrator;
use crate::ports::small_list::SmallList;
use jounce_linalg::Mat;
use jounce_model::contact::Law;

/// Largest number of simultaneous impacts with a joint solution: the solver enumerates their
/// subsets.
const MAX_SIMULTANEOUS_IMPACTS: usize = 8;

/// Fraction of the fastest speed, or of the largest impulse, that is roundoff.
const IMPULSE_ROUNDOFF: f64 = 1e-10;

/// Complementarity problem, in the order of the impacts.
struct JointImpact {
    speeds_m_s: Vec<f64>,
    rebounds: Vec<f64>,
    mobility: Mat<f64>,
}

impl JointImpact {
    /// Returns the impulses, N s; `None` without a solution.
    fn impulses_n_s(&self) -> Option<Vec<f64>> {
        let count = self.speeds_m_s.len();
        let mut subsets: Vec<u32> = (1..1 << count).collect();
        subsets.sort_by_key(|subset: &u32| std::cmp::Reverse(subset.count_ones()));
        subsets.into_iter().find_map(|subset| {
            let chosen: Vec<usize> = (0..count).filter(|a| subset & (1 << a) != 0).collect();
            self.by(&chosen)
        })
    }

    /// Returns the impulses at some stops only, if they solve the problem for all.
    fn by(&self, chosen: &[usize]) -> Option<Vec<f64>> {
        let matrix = Mat::from_fn(chosen.len(), chosen.len(), |a, b| {
            self.mobility[(chosen[a], chosen[b])]
        });
        let (values, vectors) = jounce_linalg::symmetric_eigen(&matrix)?;
        let largest = (0..chosen.len()).map(|k| values[k]).fold(0.0, f64::max);
        let mut impulses = vec![0.0; self.speeds_m_s.len()];
        for k in (0..chosen.len()).filter(|k| values[*k] > MIN_RELATIVE_MOBILITY * largest) {
            let targets = chosen
                .iter()
                .enumerate()
                .map(|(a, p)| vectors[(a, k)] * (1.0 + self.rebounds[*p]) * self.speeds_m_s[*p]);
            let size = targets.sum::<f64>() / values[k];
            chosen
                .iter()
                .enumerate()
                .for_each(|(a, p)| impulses[*p] += size * vectors[(a, k)]);
        }
        self.is_solution(&impulses, chosen).then(|| {
            impulses
                .into_iter()
                .map(|impulse: f64| impulse.max(0.0))
                .collect()
        })
    }

    fn is_solution(&self, impulses: &[f64], chosen: &[usize]) -> bool {
        let fastest = self.speeds_m_s.iter().fold(0.0, |max: f64, v| max.max(*v));
        let strongest = impulses.iter().fold(0.0, |max: f64, p| max.max(p.abs()));
        (0..impulses.len()).all(|a| {
            let speed_change: f64 = impulses
                .iter()
                .enumerate()
                .map(|(b, p)| self.mobility[(a, b)] * p)
                .sum();
            let beyond = (1.0 + self.rebounds[a]) * self.speeds_m_s[a] - speed_change;
            let meets = beyond <= IMPULSE_ROUNDOFF * fastest
                && (!chosen.contains(&a) || beyond >= -IMPULSE_ROUNDOFF * fastest);
            meets && impulses[a] >= -IMPULSE_ROUNDOFF * strongest
        })
    }
}

impl Integrator<'_> {
    /// Applies simultaneous impacts; returns the ports with an impulse, or `None` for fewer than
    /// two stops, and without a solution.
    pub(super) fn joint_impact(&mut self, impacting: &[usize]) -> Option<SmallList<usize>> {
        if !(2..=MAX_SIMULTANEOUS_IMPACTS).contains(&impacting.len()) {
            return None;
        }
        let rebound = |p: &usize| {
            if let Law::Rigid(law) = self.law(*p) {
                self.rebound(*p, law)
            } else {
                0.0
            }
        };
        let problem = JointImpact {
            speeds_m_s: impacting.iter().map(|p| self.ports[*p].rate_m_s).collect(),
            rebounds: impacting.iter().map(rebound).collect(),
            mobility: Mat::from_fn(impacting.len(), impacting.len(), |a, b| {
                self.mobility_per_kg(impacting[a], impacting[b])
            }),
        };
        let impulses = problem.impulses_n_s()?;
        let affected: Vec<usize> = (0..impacting.len())
            .filter(|a| impulses[*a] > 0.0)
            .collect();
        affected
            .iter()
            .for_each(|a| self.push_by(impacting[*a], impulses[*a]));
        for a in &affected {
            let (before, after) = (
                problem.speeds_m_s[*a],
                -problem.rebounds[*a] * problem.speeds_m_s[*a],
            );
            self.integrals.loss_j += 0.5 * impulses[*a] * (before + after);
            self.rebounds(impacting[*a], after);
        }
        Some(affected.into_iter().map(|a| impacting[a]).collect())
    }
}
