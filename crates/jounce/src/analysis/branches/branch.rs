//! What a branch answers.

use super::events::NotProved;
use crate::orbit::{Orbit, ShootingEvaluation, nearest_turn};
use faer::ColRef;
use serde::Serialize;

/// A curve of periodic orbits.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Branch {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// Points along the curve.
    pub points: Vec<BranchPoint>,
    /// Bifurcations in the order of the curve.
    pub bifurcations: Vec<Bifurcation>,
    /// Where the rule of events was not met.
    pub not_proved: Vec<NotProved>,
    /// How its two ends came about, first point and last point.
    pub endings: Vec<Termination>,
    /// Number of period doublings whose branch was not followed: the budget was spent, or Newton found no first orbit.
    pub not_followed: usize,
}

/// A point of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// The orbit.
    pub orbit: Orbit,
}

/// What happens at a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchKind {
    /// The branch turns back.
    Fold,
    /// A branch of twice the period leaves.
    PeriodDoubling,
    /// A torus leaves.
    NeimarkSacker,
    /// Another branch of the same period crosses.
    BranchPoint,
    /// A contact appears or goes.
    Grazing,
    /// Sticking to a rigid stop begins: the impacts accumulate.
    Sticking,
    /// A quantity passes a level that the user gives.
    Level,
}

/// A located bifurcation.
#[derive(Debug, Clone, PartialEq)]
pub struct Bifurcation {
    /// What it is.
    pub kind: BranchKind,
    /// The level that is passed, as it was given.
    pub level: Option<String>,
    /// Name of the stop that is grazed, or stuck to.
    pub stop: Option<String>,
    /// Where.
    pub at: BranchPoint,
}

/// How a branch ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "how")]
pub enum Termination {
    /// At the edge of the range.
    Range,
    /// It came back to its own start.
    Closed,
    /// It came to a branch of a shorter period, as a doubled one does where it began.
    Merged,
    /// After as many points as were allowed.
    Points,
    /// At a grazing, where it turns more sharply than any step can follow.
    Grazing {
        /// What stopped the walk.
        why: String,
        /// Value of the key there.
        parameter: f64,
    },
    /// Sticking to a rigid stop begins. Beyond this value the flow has no derivative.
    Sticking {
        /// What stopped the walk.
        why: String,
        /// Value of the key there.
        parameter: f64,
    },
    /// It could not be followed.
    Failed {
        /// Why.
        why: String,
        /// Last good value of the key.
        parameter: f64,
    },
}

/// State on the chord between two points.
fn between(a: &BranchPoint, b: &BranchPoint, share: f64) -> Vec<f64> {
    a.orbit
        .start()
        .iter()
        .zip(b.orbit.start())
        .map(|(a, b)| a + share * (b - a))
        .collect()
}

impl Bifurcation {
    /// A grazing, with the stop whose surface a turning point lies nearest to.
    pub(super) fn grazing(at: BranchPoint, shot: &ShootingEvaluation) -> Self {
        let stops = &shot.kernel.plant.system.stops;
        let stop = nearest_turn(shot)
            .and_then(|turn| stops.get(turn.port))
            .map(|stop| stop.name.clone());
        Self {
            kind: BranchKind::Grazing,
            level: None,
            stop,
            at,
        }
    }
}

impl BranchKind {
    /// Name in answers.
    pub fn name(self) -> &'static str {
        match self {
            BranchKind::Fold => "fold",
            BranchKind::PeriodDoubling => "period-doubling",
            BranchKind::NeimarkSacker => "neimark-sacker",
            BranchKind::BranchPoint => "branch-point",
            BranchKind::Grazing => "grazing",
            BranchKind::Sticking => "sticking",
            BranchKind::Level => "level",
        }
    }
}

impl Branch {
    /// A branch of which one orbit is known and none was followed, for want of budget.
    pub(super) fn of_one(orbit: Orbit, parameter: f64) -> Self {
        let (period_cycles, endings) = (orbit.period_cycles, vec![Termination::Points; 2]);
        Self {
            period_cycles,
            points: vec![BranchPoint { parameter, orbit }],
            endings,
            ..Self::default()
        }
    }

    /// Drive cycles of its orbits: the work that following it has cost.
    pub(super) fn work(&self) -> usize {
        self.points.len() * self.period_cycles as usize
    }

    /// Area below the mean power over the key, W times the unit of the key; parts at the same value of the key all count.
    pub(super) fn area_w(&self) -> f64 {
        let below = |pair: &[BranchPoint]| {
            (pair[1].parameter - pair[0].parameter).abs()
                * 0.5
                * (pair[0].orbit.mean_power_w + pair[1].orbit.mean_power_w)
        };
        self.points.windows(2).map(below).sum()
    }

    /// Points where the branch passes a value of the key, states and power interpolated linearly.
    pub fn crossings(&self, parameter: f64) -> Vec<(Vec<f64>, f64)> {
        let read = |(a, b, t): (&BranchPoint, &BranchPoint, f64)| {
            (
                between(a, b, t),
                a.orbit.mean_power_w + t * (b.orbit.mean_power_w - a.orbit.mean_power_w),
            )
        };
        self.passing(parameter).map(read).collect()
    }

    /// Neighbouring points between which the branch passes a value of the key, and its share of the way.
    fn passing(&self, parameter: f64) -> impl Iterator<Item = (&BranchPoint, &BranchPoint, f64)> {
        self.points.windows(2).filter_map(move |pair| {
            let (a, b) = (&pair[0], &pair[1]);
            let (low, high) = (a.parameter.min(b.parameter), a.parameter.max(b.parameter));
            let passes = (low..=high).contains(&parameter) && low < high;
            passes.then(|| {
                (
                    a,
                    b,
                    (parameter - a.parameter) / (b.parameter - a.parameter),
                )
            })
        })
    }

    /// Between two neighbouring points, the bifurcation nearest to their chord at which stability may be lost.
    pub(in crate::analysis) fn bifurcation_between(
        &self,
        [a, b]: [&BranchPoint; 2],
    ) -> Option<&BranchPoint> {
        let [from, to] = [a, b].map(|point| ColRef::from_slice(point.orbit.start()));
        let chord = to - from;
        let off = |at: &BranchPoint| {
            let way = ColRef::from_slice(at.orbit.start()) - from;
            let share = (chord.transpose() * &way) / chord.squared_norm_l2();
            let off = (way - faer::Scale(share) * &chord).norm_l2();
            ((0.0..=1.0).contains(&share) && off < chord.norm_l2()).then_some(off)
        };
        let found = self.bifurcations.iter().filter(|found| {
            !matches!(
                found.kind,
                BranchKind::Grazing | BranchKind::Sticking | BranchKind::Level
            )
        });
        let found = found.filter_map(|found| Some((off(&found.at)?, &found.at)));
        found
            .min_by(|one, two| one.0.total_cmp(&two.0))
            .map(|(_, at)| at)
    }

    /// True when none of its ends is one where it could not be followed.
    pub fn is_complete(&self) -> bool {
        !self
            .endings
            .iter()
            .any(|ending| matches!(ending, Termination::Failed { .. } | Termination::Points))
    }

    /// Joins a walk in the other direction from the same first point.
    pub fn joined(mut self, other: Branch) -> Branch {
        self.points.reverse();
        self.bifurcations.reverse();
        self.not_proved.reverse();
        self.endings.reverse();
        self.points.extend(other.points.into_iter().skip(1));
        self.bifurcations.extend(other.bifurcations);
        self.not_proved.extend(other.not_proved);
        self.endings.extend(other.endings);
        self.not_followed += other.not_followed;
        self
    }
}
