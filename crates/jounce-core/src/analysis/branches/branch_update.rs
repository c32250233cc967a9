//! Update of known branches after a small change of the design, each point independently.
//!
//! A small change of the design changes each orbit little. Newton's method corrects every known
//! point to the curve of the new design, in the hyperplane across the chord between its neighbours.
//! Points at the edges of the range keep their parameter. The points are independent, so all cores
//! work on them. The result is a fast approximation with three limits:
//!
//! - New branches are not found.
//! - Multipliers that pass a critical value and return between two points are not found.
//! - A fold is not found about which points overtake each other.
//!
//! [`BranchSearch`](super::BranchSearch) finds them all.

use super::branch::{Bifurcation, Branch, BranchPoint};
use super::orbit_point::OrbitPoint;
use super::tracer::BranchTracer;
use crate::analysis::Parameter;
use crate::continuation::{
    Corrector, CurvePoint, Direction, Metric, Position, StepControl, correct, tangent,
};
use crate::integrate::Kernel;
use crate::orbit::{OrbitMethod, Shooting};
use rayon::prelude::*;

/// Definition of an update of branches.
#[derive(Debug)]
pub struct BranchUpdate<'s> {
    /// Family of models of the new design.
    pub harvester: &'s Parameter<'s>,
    /// Kernel of one of these models.
    pub kernel: &'s Kernel,
    /// Range of the key of the known branches.
    pub range: (f64, f64),
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
    /// Length of a correction, in the metric, below which it is omitted. A state counts relative to
    /// its size, the parameter to a twentieth of the range.
    pub accuracy: f64,
    /// Length in the metric to which bifurcations are located.
    pub resolution: f64,
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
    /// Updated branches; a branch is cut where points are lost.
    pub branches: Vec<Branch>,
    /// Points at which Newton's method failed.
    pub lost: usize,
}

impl BranchUpdate<'_> {
    /// Updates the branches.
    pub fn run(&self, known: &[Branch]) -> UpdatedBranches {
        let corrector = Corrector {
            goal: self.accuracy,
            most: 6,
        };
        let following = BranchTracer {
            range: self.range,
            corrector,
            control: StepControl::default(),
            most_points: usize::MAX,
            budget: usize::MAX,
            resolution: self.resolution,
            levels: Vec::new(),
        };
        let mut carried = UpdatedBranches::default();
        for (index, branch) in known.iter().enumerate() {
            // After a branch was cut or lost, the indices do not match.
            let trend = self.trend.filter(|trend| trend.before.len() == known.len());
            let likely = trend.and_then(|trend| trend.likely(index, branch));
            self.carry(&following, branch, likely.as_deref(), &mut carried);
        }
        carried
    }

    fn carry(
        &self,
        following: &BranchTracer,
        branch: &Branch,
        likely: Option<&[Position]>,
        carried: &mut UpdatedBranches,
    ) {
        let shooting = Shooting::new(
            self.harvester,
            self.kernel,
            branch.period_cycles,
            self.tolerance,
        );
        if branch
            .points
            .iter()
            .any(|point| point.orbit.start().len() != shooting.scale.len())
        {
            carried.lost += branch.points.len();
            return;
        }
        let place = |index: usize, guess: Option<Position>| {
            self.place(following, &shooting, &branch.points, (index, guess))
        };
        let count = branch.points.len();
        let first = |index: usize| {
            likely
                .and_then(|likely| place(index, Some(likely[index].clone())))
                .or_else(|| place(index, None))
        };
        let mut found: Vec<_> = (0..count).into_par_iter().map(first).collect();
        // A point with a failed correction, for example near a fold, is moved as its neighbours
        // were.
        loop {
            let again = |index: usize| {
                let beside = [index.wrapping_sub(1), index + 1]
                    .into_iter()
                    .filter(|other| *other < count);
                let (other, moved) = beside
                    .filter(|_| found[index].is_none())
                    .find_map(|other| Some((other, found[other].as_ref()?)))?;
                let guess = at(&branch.points[index])
                    .moved(&at(&branch.points[other]).to(&moved.step.position), 1.0);
                Some((index, place(index, Some(guess))?))
            };
            let more: Vec<_> = (0..count).into_par_iter().filter_map(again).collect();
            if more.is_empty() {
                break;
            }
            more.into_iter()
                .for_each(|(index, place)| found[index] = Some(place));
        }
        carried.lost += found.iter().filter(|place| place.is_none()).count();
        let is_inside = |value: f64| (self.range.0..=self.range.1).contains(&value);
        let ends = |place: &Option<_>| {
            !place
                .as_ref()
                .is_some_and(|place: &OrbitPoint<_>| is_inside(place.step.position.parameter))
        };
        for run in found.split(ends).filter(|run| run.len() > 1) {
            let places: Vec<_> = run.iter().flatten().collect();
            let between = places.par_windows(2).map(|pair| {
                following
                    .between(&shooting, pair[0], pair[1])
                    .unwrap_or_default()
            });
            let bifurcations: Vec<Vec<Bifurcation>> = between.collect();
            carried.branches.push(Branch {
                period_cycles: branch.period_cycles,
                points: places.iter().map(|place| place.point.clone()).collect(),
                bifurcations: bifurcations.into_iter().flatten().collect(),
                not_proved: Vec::new(),
                endings: branch.endings.clone(),
                not_followed: 0,
            });
        }
    }

    /// Returns the corrected point, from a guess or from its old position.
    fn place<M: OrbitMethod>(
        &self,
        following: &BranchTracer,
        method: &M,
        points: &[BranchPoint],
        (index, guess): (usize, Option<Position>),
    ) -> Option<OrbitPoint<M>> {
        let here = at(&points[index]);
        let metric = Metric::at(&here, following.parameter_scale());
        let chord = metric.unit(
            at(&points[index.saturating_sub(1)])
                .to(&at(&points[(index + 1).min(points.len() - 1)])),
        );
        let at_edge = here.parameter == self.range.0 || here.parameter == self.range.1;
        let upright = Direction {
            unknown: vec![0.0; here.unknown.len()],
            parameter: metric.parameter,
        };
        let mut guess = guess.unwrap_or_else(|| here.clone());
        if at_edge {
            guess.parameter = here.parameter;
        }
        let found = correct(
            method,
            &following.corrector,
            &metric,
            if at_edge { &upright } else { &chord },
            guess,
        )
        .ok()?;
        let tangent = tangent(&found.local, &metric, &chord)?;
        let step = CurvePoint {
            position: found.position,
            tangent,
            local: found.local,
            error: found.error,
        };
        OrbitPoint::new(method, step).ok()
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
                .map(|(before, point)| at(point).moved(&at(before).to(&at(point)), self.reach))
                .collect(),
        )
    }
}

/// Returns the position of a point.
fn at(point: &BranchPoint) -> Position {
    Position {
        unknown: point.orbit.start().to_vec(),
        parameter: point.parameter,
    }
}
