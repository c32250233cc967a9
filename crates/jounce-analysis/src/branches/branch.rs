//! Results of a search for branches.

use super::events::{NotProved, StepEvents};
use jounce_linalg::Mat;
use jounce_orbits::{Orbit, ShootingEvaluation, nearest_turn};
use serde::Serialize;

/// Curve of periodic orbits.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Branch {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// Points along the curve.
    pub points: Vec<BranchPoint>,
    /// Bifurcations in the order of the curve.
    pub bifurcations: Vec<Bifurcation>,
    /// Intervals where the events are not proved complete.
    pub not_proved: Vec<NotProved>,
    /// Terminations of both ends: first point, then last point.
    pub endings: Vec<Termination>,
    /// Number of period doublings whose branch was not followed: the budget was spent, or Newton's
    /// method found no first orbit.
    pub not_followed: usize,
}

/// Point of a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// The orbit.
    pub orbit: Orbit,
}

/// Kind of a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BranchKind {
    /// The branch turns back in the key.
    Fold,
    /// A branch of twice the period begins.
    PeriodDoubling,
    /// A torus begins.
    NeimarkSacker,
    /// Another branch of the same period crosses.
    BranchPoint,
    /// A contact appears or disappears.
    Grazing,
    /// Sticking to a rigid stop begins: the impacts accumulate.
    Sticking,
    /// A quantity crosses a level specified by the user.
    Level,
}

/// Located bifurcation.
#[derive(Debug, Clone, PartialEq)]
pub struct Bifurcation {
    /// Kind of the bifurcation.
    pub kind: BranchKind,
    /// Level that is crossed, as specified.
    pub level: Option<String>,
    /// Name of the stop of a grazing or of sticking.
    pub stop: Option<String>,
    /// Point of the branch.
    pub at: BranchPoint,
    /// Estimated error of the key there, SI; `None` where the event ended the branch.
    pub parameter_error: Option<f64>,
    /// Values of the key at the neighbouring points of the branch, SI; `None` where the event ended
    /// the branch.
    pub neighbours: Option<[f64; 2]>,
}

/// Termination of a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "how")]
pub enum Termination {
    /// At the edge of the range.
    Range,
    /// The branch returned to its own start.
    Closed,
    /// The branch reached a branch of a shorter period; a doubled branch does so where it began.
    Merged,
    /// The limit of points was reached.
    Points,
    /// At a grazing, where the branch turns more sharply than any step can follow.
    Grazing {
        /// Reason of the failed step.
        why: String,
        /// Value of the key there.
        parameter: f64,
    },
    /// Sticking to a rigid stop begins. Beyond this value the flow has no derivative.
    Sticking {
        /// Reason of the failed step.
        why: String,
        /// Value of the key there.
        parameter: f64,
    },
    /// Continuation failed.
    Failed {
        /// Reason of the failure.
        why: String,
        /// Last good value of the key.
        parameter: f64,
    },
}

/// Returns the state on the chord between two points.
fn between(a: &BranchPoint, b: &BranchPoint, share: f64) -> Vec<f64> {
    a.orbit
        .start()
        .iter()
        .zip(b.orbit.start())
        .map(|(a, b)| a + share * (b - a))
        .collect()
}

impl Bifurcation {
    /// Creates a grazing at the stop whose surface is nearest to a turning point.
    pub(super) fn grazing(at: BranchPoint, evaluation: &ShootingEvaluation) -> Self {
        let stops = &evaluation.kernel.plant.system.stops;
        let stop = nearest_turn(evaluation)
            .and_then(|turn| stops.get(turn.port))
            .map(|stop| stop.name.clone());
        Self {
            kind: BranchKind::Grazing,
            level: None,
            stop,
            at,
            parameter_error: None,
            neighbours: None,
        }
    }
}

impl BranchKind {
    /// Returns the name in results.
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
    /// Creates a branch of one known orbit that was not followed, for lack of budget.
    pub(super) fn of_one(orbit: Orbit, parameter: f64) -> Self {
        let (period_cycles, endings) = (orbit.period_cycles, vec![Termination::Points; 2]);
        Self {
            period_cycles,
            points: vec![BranchPoint { parameter, orbit }],
            endings,
            ..Self::default()
        }
    }

    /// Adds the events of a step.
    pub(super) fn add_events(&mut self, mut events: StepEvents) {
        self.not_proved.append(&mut events.not_proved);
        self.bifurcations.extend(events.bifurcations());
    }

    /// Returns the number of drive cycles of all orbits, a measure of the cost of the continuation.
    pub(super) fn work(&self) -> usize {
        self.points.len() * self.period_cycles as usize
    }

    /// Returns the area below the mean power over the key, W times the unit of the key. Parts at
    /// the same value of the key all count.
    pub(super) fn area_w(&self) -> f64 {
        let below = |pair: &[BranchPoint]| {
            (pair[1].parameter - pair[0].parameter).abs()
                * 0.5
                * (pair[0].orbit.mean_power_w + pair[1].orbit.mean_power_w)
        };
        self.points.windows(2).map(below).sum()
    }

    /// Returns the points where the branch crosses a value of the key, with linearly interpolated
    /// states and power.
    pub fn crossings(&self, parameter: f64) -> Vec<(Vec<f64>, f64)> {
        let read = |(a, b, t): (&BranchPoint, &BranchPoint, f64)| {
            (
                between(a, b, t),
                a.orbit.mean_power_w + t * (b.orbit.mean_power_w - a.orbit.mean_power_w),
            )
        };
        self.passing(parameter).map(read).collect()
    }

    /// Returns neighbouring points between which the branch crosses a value of the key, and the
    /// fraction of the step.
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

    /// Returns the bifurcation between two neighbouring points nearest to their chord, of a kind
    /// that can change stability.
    pub(crate) fn bifurcation_between(&self, [a, b]: [&BranchPoint; 2]) -> Option<&BranchPoint> {
        let start = |point: &BranchPoint| {
            let start = point.orbit.start();
            Mat::from_column_slice(start.len(), 1, start)
        };
        let (from, to) = (start(a), start(b));
        let chord = to - &from;
        let distance = |at: &BranchPoint| {
            let offset = start(at) - &from;
            let share = chord.dot(&offset) / chord.norm_squared();
            let distance = (offset - &chord * share).norm();
            ((0.0..=1.0).contains(&share) && distance < chord.norm()).then_some(distance)
        };
        let candidates = self.bifurcations.iter().filter(|candidate| {
            !matches!(
                candidate.kind,
                BranchKind::Grazing | BranchKind::Sticking | BranchKind::Level
            )
        });
        let candidates =
            candidates.filter_map(|candidate| Some((distance(&candidate.at)?, &candidate.at)));
        candidates
            .min_by(|one, two| one.0.total_cmp(&two.0))
            .map(|(_, at)| at)
    }

    /// True when continuation failed at no end.
    pub fn is_complete(&self) -> bool {
        !self
            .endings
            .iter()
            .any(|ending| matches!(ending, Termination::Failed { .. } | Termination::Points))
    }

    /// Joins the continuation in the other direction from the same first point.
    pub fn joined(mut self, other: Branch) -> Branch {
        self.points.reverse();
        self.bifurcations.reverse();
        let neighbours = self.bifurcations.iter_mut();
        neighbours
            .filter_map(|bifurcation| bifurcation.neighbours.as_mut())
            .for_each(|ends| ends.reverse());
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
