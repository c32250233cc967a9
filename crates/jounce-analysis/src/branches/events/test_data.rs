//! Data of the test functions of a point and of one slightly ahead on the curve; the difference is
//! the derivative along it.

use super::level::QuantityLevel;
use super::pairing::paired;
use jounce_continuation::{CurvePoint, Metric};
use jounce_linalg::c64;
use jounce_orbits::{Orbit, OrbitMethod, ShootingEvaluation, TurningPoint, discs, turns};

/// Distance ahead, in the metric, relative to the square root of the tolerance of the integrations.
/// There the integration error in the difference and the neglected curvature are about equal.
const SLOPE_DISTANCE: f64 = 10.0;

/// Returns the distance ahead, in the metric, for a tolerance of the integrations.
pub(in crate::branches) fn slope_distance(tolerance: f64) -> f64 {
    SLOPE_DISTANCE * tolerance.sqrt()
}

/// Data of the test functions of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::branches) struct TestData {
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
pub(in crate::branches) struct TestDataPair {
    pub current: TestData,
    /// Multipliers ahead.
    pub multipliers: Vec<c64>,
    /// Turning points ahead; `None` where one disappears on the way.
    pub turns: Vec<Option<TurningPoint>>,
    /// Levels ahead.
    pub levels: Vec<f64>,
    /// Distance from here to ahead, in the metric.
    pub length: f64,
    /// Error of the orbit, relative to its size.
    pub error: f64,
}

impl TestData {
    fn of(
        evaluation: &ShootingEvaluation,
        multipliers: Vec<c64>,
        levels: &[QuantityLevel],
    ) -> Self {
        let switches = evaluation
            .trajectories
            .iter()
            .any(|trajectory| !trajectory.changes().is_empty());
        Self {
            multipliers,
            radii: Vec::new(),
            turns: turns(evaluation),
            levels: levels
                .iter()
                .map(|level| level.relative_difference(evaluation))
                .collect(),
            period_s: evaluation.period_s,
            cycles: evaluation.trajectories.len(),
            is_free: evaluation.contacts == 0 && evaluation.max_penetration_m == 0.0 && !switches,
        }
    }

    /// Adds for each multiplier the radius of the disc of the nearest block.
    fn with_radii(mut self, evaluation: &ShootingEvaluation) -> Self {
        let discs = discs(
            &evaluation.block_map,
            evaluation.kernel.plant.diagonal.block.pairs.len(),
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
        let evaluation = method.shot(&step.local).ok()?;
        let data =
            TestData::of(evaluation, orbit.multipliers.clone(), levels).with_radii(evaluation);
        let metric = Metric::at(&step.position, parameter_scale);
        let unit = metric.unit(step.tangent.clone());
        let on_side = |side: f64| {
            let length = side * slope_distance(evaluation.tolerance());
            let neighbour = step.position.offset_along(&unit, length);
            let local = method.at(&neighbour.unknown, neighbour.parameter).ok()?;
            let near = method.shot(&local).ok()?;
            let multipliers = evaluation.eigenbasis()?.multipliers_of(&near.block_map)?;
            let reading = TestData::of(near, multipliers, levels);
            Some((
                near.contacts == evaluation.contacts,
                Self::joined(data.clone(), &reading, length, orbit.error_estimate),
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

    fn joined(data: TestData, other: &TestData, length: f64, error: f64) -> Self {
        let distance = |i: usize, j: usize| (data.multipliers[i] - other.multipliers[j]).norm_sqr();
        let same = paired(data.multipliers.len(), other.multipliers.len(), distance);
        let multipliers = same
            .into_iter()
            .map(|(_, j)| other.multipliers[j])
            .collect();
        let mut turns = vec![None; data.turns.len()];
        for (i, j) in paired(data.turns.len(), other.turns.len(), |i, j| {
            phase_shift((&data, &data.turns[i]), (other, &other.turns[j])).abs()
        }) {
            turns[i] = Some(other.turns[j]);
        }
        Self {
            current: data,
            multipliers,
            turns,
            levels: other.levels.clone(),
            length,
            error,
        }
    }
}

/// Returns the difference in phase between turning points of two orbits; infinite where they are of
/// different kinds.
pub(super) fn phase_shift(
    (one, from): (&TestData, &TurningPoint),
    (two, to): (&TestData, &TurningPoint),
) -> f64 {
    if (from.port, from.is_maximum) != (to.port, to.is_maximum) {
        return f64::INFINITY;
    }
    let phase_shift = two.phase(to) - one.phase(from);
    phase_shift - phase_shift.round()
}
