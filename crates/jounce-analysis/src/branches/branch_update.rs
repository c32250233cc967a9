//! Update of known branches after a small change of the design, each point independently.
//!
//! A small change of the design changes each orbit little. Newton's method corrects every known
//! point to the curve of the new design, in the hyperplane across the chord between its neighbours.
//! Points at the edges of the range keep their parameter. The points are independent, so all cores
//! work on them. The result is a fast approximation: new branches and bifurcations are not found.
//! [`BranchSearch`](super::BranchSearch) finds them.

use super::branch::{Branch, BranchPoint};
use super::branch_tracer::tracer::parameter_scale;
use crate::Parameter;
use jounce_continuation::{Corrector, Direction, Metric, Position, correct};
use jounce_dynamics::Kernel;
use jounce_orbits::{OrbitMethod, Shooting};
use rayon::prelude::*;

/// Largest number of evaluations of a correction.
const MAX_EVALUATIONS: u32 = 6;

/// Definition of an update of branches.
#[derive(Debug)]
pub struct BranchUpdate<'s> {
    /// Family of models of the new design.
    pub family: &'s Parameter<'s>,
    /// Kernel of one of these models.
    pub kernel: &'s Kernel,
    /// Range of the key of the known branches.
    pub range: (f64, f64),
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
    /// Length of a correction, in the metric, below which it is omitted. A state counts relative to
    /// its size, the parameter to a twentieth of the range.
    pub accuracy: f64,
    /// Previous change of the design, for the prediction of the points.
    pub trend: Option<Extrapolation<'s>>,
}

/// Extrapolation of the points from the previous change of the design.
#[derive(Debug, Clone, Copy)]
pub struct Extrapolation<'s> {
    /// Branches before the previous change, point by point.
    pub before: &'s [Branch],
    /// Ratio of the new change of the design to the previous one.
    pub reach: f64,
}

/// Result of an update.
#[derive(Debug, Default)]
pub struct UpdatedBranches {
    /// Updated branches, without bifurcations; a branch is cut where points are lost.
    pub branches: Vec<Branch>,
    /// Points at which Newton's method failed.
    pub lost: usize,
}

impl BranchUpdate<'_> {
    /// Updates the branches.
    pub fn run(&self, known: &[Branch]) -> UpdatedBranches {
        let mut updated = UpdatedBranches::default();
        for (index, branch) in known.iter().enumerate() {
            // After a branch was cut or lost, the indices do not match.
            let extrapolation = self
                .trend
                .filter(|extrapolation| extrapolation.before.len() == known.len());
            let predicted_positions =
                extrapolation.and_then(|extrapolation| extrapolation.likely(index, branch));
            self.update_branch(branch, predicted_positions.as_deref(), &mut updated);
        }
        updated
    }

    /// Adds the updated pieces of a branch to the result.
    fn update_branch(
        &self,
        branch: &Branch,
        predicted_positions: Option<&[Position]>,
        updated: &mut UpdatedBranches,
    ) {
        let shooting = Shooting::new(
            self.family,
            self.kernel,
            branch.period_cycles,
            self.tolerance,
        );
        if branch
            .points
            .iter()
            .any(|point| point.orbit.start().len() != shooting.scale.len())
        {
            updated.lost += branch.points.len();
            return;
        }
        let updated_points = self.corrected_points(&shooting, &branch.points, predicted_positions);
        updated.lost += updated_points
            .iter()
            .filter(|corrected| corrected.is_none())
            .count();
        let is_inside = |value: f64| (self.range.0..=self.range.1).contains(&value);
        let ends = |corrected: &Option<BranchPoint>| {
            !corrected
                .as_ref()
                .is_some_and(|point| is_inside(point.parameter))
        };
        for run in updated_points.split(ends).filter(|run| run.len() > 1) {
            updated.branches.push(Branch {
                period_cycles: branch.period_cycles,
                points: run.iter().flatten().cloned().collect(),
                endings: branch.endings.clone(),
                ..Branch::default()
            });
        }
    }

    /// Corrects all points of a branch: from their predicted positions, then from their old ones,
    /// then from those of corrected neighbours.
    fn corrected_points(
        &self,
        shooting: &Shooting<'_, Parameter<'_>>,
        points: &[BranchPoint],
        predicted_positions: Option<&[Position]>,
    ) -> Vec<Option<BranchPoint>> {
        let corrected = |index: usize, guess: Option<Position>| {
            self.corrected(shooting, points, (index, guess))
        };
        let count = points.len();
        let first = |index: usize| {
            predicted_positions
                .and_then(|predicted_positions| {
                    corrected(index, Some(predicted_positions[index].clone()))
                })
                .or_else(|| corrected(index, None))
        };
        let mut updated_points: Vec<_> = (0..count).into_par_iter().map(first).collect();
        // A point with a failed correction, for example near a fold, is moved as its neighbours
        // were.
        loop {
            let retry = |index: usize| {
                let neighbours = [index.wrapping_sub(1), index + 1]
                    .into_iter()
                    .filter(|other| *other < count);
                let (other, neighbour_point) = neighbours
                    .filter(|_| updated_points[index].is_none())
                    .find_map(|other| Some((other, updated_points[other].as_ref()?)))?;
                let guess = at(&points[index])
                    .offset_along(&at(&points[other]).to(&at(neighbour_point)), 1.0);
                Some((index, corrected(index, Some(guess))?))
            };
            let more: Vec<_> = (0..count).into_par_iter().filter_map(retry).collect();
            if more.is_empty() {
                return updated_points;
            }
            more.into_iter()
                .for_each(|(index, corrected)| updated_points[index] = Some(corrected));
        }
    }

    /// Returns the corrected point, from a guess or from its old position.
    fn corrected<M: OrbitMethod>(
        &self,
        method: &M,
        points: &[BranchPoint],
        (index, guess): (usize, Option<Position>),
    ) -> Option<BranchPoint> {
        let position = at(&points[index]);
        let metric = Metric::at(&position, parameter_scale(self.range));
        let at_edge = position.parameter == self.range.0 || position.parameter == self.range.1;
        let mut guess = guess.unwrap_or_else(|| position.clone());
        let normal = if at_edge {
            guess.parameter = position.parameter;
            Direction {
                unknown: vec![0.0; position.unknown.len()],
                parameter: metric.parameter,
            }
        } else {
            let before = at(&points[index.saturating_sub(1)]);
            let after = at(&points[(index + 1).min(points.len() - 1)]);
            metric.unit(before.to(&after))
        };
        let corrector = Corrector {
            goal: self.accuracy,
            most: MAX_EVALUATIONS,
        };
        let corrected = correct(method, &corrector, &metric, &normal, guess).ok()?;
        let orbit = method.orbit(&corrected.local, corrected.error).ok()?;
        Some(BranchPoint {
            parameter: corrected.position.parameter,
            orbit,
        })
    }
}

impl Extrapolation<'_> {
    /// Predicts the points of a branch, if each of them has a known predecessor.
    fn likely(&self, index: usize, branch: &Branch) -> Option<Vec<Position>> {
        let before = self
            .before
            .get(index)
            .filter(|before| before.points.len() == branch.points.len())?;
        let pairs = before.points.iter().zip(&branch.points);
        Some(
            pairs
                .map(|(before, point)| {
                    at(point).offset_along(&at(before).to(&at(point)), self.reach)
                })
                .collect(),
        )
    }
}

/// Returns the position of a point.
pub(super) fn at(point: &BranchPoint) -> Position {
    Position {
        unknown: point.orbit.start().to_vec(),
        parameter: point.parameter,
    }
}
