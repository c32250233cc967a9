//! Attractors of a cloud of starts, and the peaks of quantities on them.

use super::nearest_fold::fold_distance_hz;
use super::{Effort, InCondition, MainOrbit, PROBE_STARTS, SCREENING_STARTS};
use crate::problem::{Goal, LimitedQuantity, Problem, larger};
use jounce_analysis::{
    AnalysisError, Attractor, Basins, BasinsResult, Cloud, InitialStates, KeyLine, Model,
    Recognition, farthest_hz,
};
use jounce_orbits::{Orbit, OrbitQuantity, Shooting};

/// Size of the cloud of starts, in gaps or steady amplitudes.
const SPREAD: f64 = 10.0;

/// Tolerance and largest number of drive cycles of a first evaluation.
const SCREENING_TOLERANCE: f64 = 1e-7;
const SCREENING_CYCLES: u32 = 300;

/// Tolerance of an evaluation with all starts.
const TOLERANCE: f64 = 1e-8;

/// Largest number of drive cycles of an evaluation with all starts.
const MAX_CYCLES: u32 = 600;

/// Evaluates the goals and limits of orbits.
pub(super) fn evaluate(
    problem: &Problem,
    model: &Model,
    effort: Effort,
) -> Result<InCondition, AnalysisError> {
    let (starts, recognition) = settings(problem, effort);
    let line = KeyLine::at(model);
    let result = reached(problem, model, (starts, recognition))?;
    let main = main_attractor(problem, &result);
    let orbits = reached_orbits(&result, main);
    let peaks = Peaks {
        line: &line,
        model,
        tolerance: recognition.tolerance,
    };
    let limit = |quantity| match quantity {
        LimitedQuantity::MeanPower => expected_w(&result),
        LimitedQuantity::BasinFraction => main.map_or(0.0, |main| main.share.fraction),
        LimitedQuantity::Peak(quantity) => peaks.largest(&result, quantity),
        LimitedQuantity::FoldDistance => match (effort, orbits.first()) {
            // A branch costs more than the starts of a first evaluation, which does not judge it.
            (Effort::Probe | Effort::Screening, _) => farthest_hz(model).unwrap_or(f64::NAN),
            (Effort::Full, Some(orbit)) => fold_distance_hz(model, orbit),
            (Effort::Full, None) => f64::NAN,
        },
        LimitedQuantity::Size(_) => f64::NAN,
    };
    let aperiodic = result.attractors.iter().filter(|one| one.orbit().is_none());
    let lost = result.lost.len() as f64 / starts as f64;
    let goal = |goal: &Goal| match goal {
        Goal::ExpectedPower => expected_w(&result),
        Goal::StablePower => main.map_or(0.0, |main| main.mean_power_w),
        Goal::Bandwidth | Goal::MeanPower | Goal::TimeOn | Goal::PowerMargin => f64::NAN,
    };
    Ok(InCondition {
        goals: problem.goals.iter().map(goal).collect(),
        limits: problem
            .limits
            .iter()
            .map(|one| limit(one.quantity))
            .collect(),
        unknown_share: lost + aperiodic.map(|one| one.share.fraction).sum::<f64>(),
        expected_power_w: [
            expected_w(&result),
            result.expected_power_low_w,
            result.expected_power_high_w,
        ],
        basin_fraction: main.map_or([0.0; 3], |main| {
            [main.share.fraction, main.share.low, main.share.high]
        }),
        orbits,
    })
}

/// Integrates the starts.
fn reached(
    problem: &Problem,
    model: &Model,
    (starts, recognition): (usize, Recognition),
) -> Result<BasinsResult, AnalysisError> {
    let study = Basins {
        base: model,
        starts: InitialStates::Cloud(Cloud {
            starts,
            seed: problem.seed,
            spread: SPREAD,
        }),
        recognition,
    };
    study.run()
}

/// Returns the number of starts and the options of their integration.
fn settings(problem: &Problem, effort: Effort) -> (usize, Recognition) {
    let (starts, max_cycles, tolerance) = match effort {
        Effort::Probe => (PROBE_STARTS, SCREENING_CYCLES, SCREENING_TOLERANCE),
        Effort::Screening => (SCREENING_STARTS, SCREENING_CYCLES, SCREENING_TOLERANCE),
        Effort::Full => (problem.starts, MAX_CYCLES, TOLERANCE),
    };
    let recognition = Recognition {
        max_cycles,
        examines_chaos: false,
        ..Recognition::at(tolerance)
    };
    (starts.min(problem.starts), recognition)
}

/// Returns the expected power, W. A start without a proved attractor has no power: its motion may be
/// a transient.
fn expected_w(result: &BasinsResult) -> f64 {
    let undecided: f64 = result
        .attractors
        .iter()
        .filter(|one| one.orbit().is_none())
        .map(|one| one.share.fraction * one.mean_power_w)
        .sum();
    result.expected_power_w - undecided
}

/// Returns the periodic attractor that contributes most to the goal.
fn main_attractor<'r>(problem: &Problem, result: &'r BasinsResult) -> Option<&'r Attractor> {
    let stable_power = problem.goals.contains(&Goal::StablePower);
    let contribution = |one: &Attractor| match stable_power {
        true => one.mean_power_w,
        false => one.share.fraction * one.mean_power_w,
    };
    result
        .attractors
        .iter()
        .filter(|one| one.orbit().is_some())
        .max_by(|a, b| contribution(a).total_cmp(&contribution(b)))
}

/// Returns the orbits that the starts reach, the main one first.
fn reached_orbits(result: &BasinsResult, main: Option<&Attractor>) -> Vec<MainOrbit> {
    let is_other = |one: &&Attractor| main.is_none_or(|main| main.id != one.id);
    let others = result.attractors.iter().filter(is_other);
    let all = main.into_iter().chain(others);
    all.filter_map(|one| Some(main_orbit(one, one.orbit()?)))
        .collect()
}

fn main_orbit(attractor: &Attractor, orbit: &Orbit) -> MainOrbit {
    MainOrbit {
        period_cycles: orbit.period_cycles,
        state: orbit.start().to_vec(),
        mean_power_w: attractor.mean_power_w,
    }
}

/// Largest values of quantities over the periodic attractors of a model.
struct Peaks<'m> {
    line: &'m KeyLine<'m>,
    model: &'m Model,
    tolerance: f64,
}

impl Peaks<'_> {
    /// NaN where an orbit cannot be integrated, or where there is none.
    fn largest(&self, result: &BasinsResult, quantity: OrbitQuantity) -> f64 {
        let orbits = result.attractors.iter().filter_map(|one| one.orbit());
        let peaks = orbits.map(|orbit| self.of(orbit, quantity));
        peaks.reduce(larger).unwrap_or(f64::NAN)
    }

    fn of(&self, orbit: &Orbit, quantity: OrbitQuantity) -> f64 {
        let kernel = &self.model.kernel;
        let shooting = Shooting::new(self.line, kernel, orbit.period_cycles, self.tolerance);
        let copy = self.line.model(0.0).map(|model| model.kernel);
        let evaluation = copy
            .ok()
            .and_then(|kernel| shooting.integrated(kernel, orbit.start()).ok());
        evaluation.map_or(f64::NAN, |evaluation| quantity.of(&evaluation))
    }
}
