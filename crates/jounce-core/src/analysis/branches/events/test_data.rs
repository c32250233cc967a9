//! Data of the test functions of a point and of one slightly ahead on the curve; the difference is
//! the derivative along it.

use super::level::QuantityLevel;
use super::pairing::paired;
use crate::continuation::{CurvePoint, Metric};
use crate::orbit::{
    Orbit, OrbitMethod, ShootingEvaluation, TurningPoint, discs, multipliers, turns,
};
use faer::c64;

/// Distance ahead, in the metric, relative to the square root of the tolerance of the integrations.
/// There the integration error in the difference and the neglected curvature are about equal.
const SLOPE_DISTANCE: f64 = 10.0;

/// Data of the test functions of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::analysis::branches) struct TestData {
    /// Floquet multipliers.
    pub multipliers: Vec<c64>,
    /// Radius of the disc about zero that bounds each multiplier, by its block.
    pub radii: Vec<f64>,
    /// Turning points of the ports.
    pub turns: Vec<TurningPoint>,
    /// Values of the quantities with a level, minus the level.
    pub levels: Vec<f64>,
    /// Period, s.
    pub period_s: f64,
    /// Drive cycles of the period.
    pub cycles: usize,
    /// True where no stop and no switch acts.
    pub is_free: bool,
}

/// Data at two points near each other; the data ahead are in the order of those here.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::analysis::branches) struct TestDataPair {
    pub here: TestData,
    /// Multipliers ahead.
    pub multipliers: Vec<c64>,
    /// Turning points ahead; `None` where one disappears on the way.
    pub turns: Vec<Option<TurningPoint>>,
    /// Levels ahead.
    pub levels: Vec<f64>,
    /// Distance from here to ahead, in the metric.
    pub length: f64,
}

impl TestData {
    fn of(shot: &ShootingEvaluation, multipliers: Vec<c64>, levels: &[QuantityLevel]) -> Self {
        let switches = shot
            .trajectories
            .iter()
            .any(|trajectory| !trajectory.changes().is_empty());
        Self {
            multipliers,
            radii: Vec::new(),
            turns: turns(shot),
            levels: levels.iter().map(|level| level.off(shot)).collect(),
            period_s: shot.period_s,
            cycles: shot.trajectories.len(),
            is_free: shot.contacts == 0 && shot.max_penetration_m == 0.0 && !switches,
        }
    }

    /// Adds for each multiplier the radius of the disc of the nearest block.
    fn with_radii(mut self, shot: &ShootingEvaluation) -> Self {
        let discs = discs(
            &shot.block_map,
            shot.kernel.plant.diagonal.block.pairs.len(),
        );
        let pairs = paired(self.multipliers.len(), discs.len(), |i, j| {
            (self.multipliers[i] - discs[j].value).norm_sqr()
        });
        self.radii = pairs.into_iter().map(|(_, j)| discs[j].radius).collect();
        self
    }

    /// Returns the time of a turning point as a fraction of the period.
    pub fn phase(&self, turn: &TurningPoint) -> f64 {
        (turn.cycle as f64 / self.cycles as f64 + turn.time_s / self.period_s).rem_euclid(1.0)
    }
}

impl TestDataPair {
    /// Computes the data at a step of a curve, in the direction of its tangent or against it;
    /// `None` where the integration fails on both sides.
    pub fn of<M: OrbitMethod>(
        method: &M,
        (step, orbit): (&CurvePoint<M::Evaluation>, &Orbit),
        parameter_scale: f64,
        levels: &[QuantityLevel],
    ) -> Option<Self> {
        let shot = method.shot(&step.local).ok()?;
        let here = TestData::of(shot, orbit.multipliers.clone(), levels).with_radii(shot);
        let metric = Metric::at(&step.position, parameter_scale);
        let unit = metric.unit(step.tangent.clone());
        let on_side = |side: f64| {
            let length = side * SLOPE_DISTANCE * shot.tolerance().sqrt();
            let there = step.position.moved(&unit, length);
            let local = method.at(&there.unknown, there.parameter).ok()?;
            let near = method.shot(&local).ok()?;
            let reading = TestData::of(near, multipliers(&near.block_map)?, levels);
            Some((
                near.contacts == shot.contacts,
                Self::joined(here.clone(), &reading, length),
            ))
        };
        // The flow has no derivative across a grazing on a rigid stop: the difference is taken on
        // the side with the same contacts.
        let mut other = None;
        for side in [1.0, -1.0] {
            match on_side(side) {
                Some((true, found)) => return Some(found),
                found => other = other.or(found.map(|(_, found)| found)),
            }
        }
        other
    }

    fn joined(here: TestData, ahead: &TestData, length: f64) -> Self {
        let apart = |i: usize, j: usize| (here.multipliers[i] - ahead.multipliers[j]).norm_sqr();
        let same = paired(here.multipliers.len(), ahead.multipliers.len(), apart);
        let multipliers = same
            .into_iter()
            .map(|(_, j)| ahead.multipliers[j])
            .collect();
        let mut turns = vec![None; here.turns.len()];
        for (i, j) in paired(here.turns.len(), ahead.turns.len(), |i, j| {
            way((&here, &here.turns[i]), (ahead, &ahead.turns[j])).abs()
        }) {
            turns[i] = Some(ahead.turns[j]);
        }
        Self {
            here,
            multipliers,
            turns,
            levels: ahead.levels.clone(),
            length,
        }
    }
}

/// Returns the difference in phase between turning points of two orbits; infinite where they are of
/// different kinds.
pub(super) fn way(
    (one, from): (&TestData, &TurningPoint),
    (two, to): (&TestData, &TurningPoint),
) -> f64 {
    if (from.port, from.is_maximum) != (to.port, to.is_maximum) {
        return f64::INFINITY;
    }
    let way = two.phase(to) - one.phase(from);
    way - way.round()
}
