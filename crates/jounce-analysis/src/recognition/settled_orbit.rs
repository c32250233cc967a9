//! Orbits reached from single starts.

use super::attracting_orbit::AttractingOrbit;
use super::recognizer::{Recognition, Recognizer};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_orbits::{Orbit, OrbitMethod, ParametricModel, Shooting};
use std::sync::Arc;

/// Largest number of drive cycles for a start.
const MAX_CYCLES: u32 = 4096;

/// Tolerance sufficient to recognize an orbit; Newton's method then finds it at the requested
/// tolerance.
const RECOGNITION_TOLERANCE: f64 = 1e-8;

/// Largest number of evaluations of Newton's method.
const MAX_EVALUATIONS: u32 = 12;

/// Returns the stable orbit that the motion from `start` (physical) reaches, provided it can be
/// followed: it does not rest on a rigid stop. `None` where no orbit is proved to be reached.
/// `correction_goal` is the goal of Newton's method, relative to the state.
pub fn settled_orbit<H: ParametricModel>(
    family: &H,
    parameter: f64,
    start: &[f64],
    tolerance: f64,
    correction_goal: f64,
) -> Option<Orbit> {
    let orbit = settled_orbits(family, parameter, &[start.to_vec()], tolerance).pop()??;
    let setting = family.at(parameter).ok()?;
    let physical = Shooting::new(family, &setting.kernel, 1, tolerance).physical(orbit.start());
    let shooting = Shooting::new(family, &setting.kernel, orbit.period_cycles, tolerance)
        .charged_as(&physical);
    let position = Position {
        unknown: orbit.start().to_vec(),
        parameter,
    };
    let metric = Metric::at(&position, 1.0);
    let corrected = correct_at(
        &shooting,
        &Corrector {
            goal: correction_goal,
            most: MAX_EVALUATIONS,
        },
        &metric,
        position,
    )
    .ok()?;
    shooting.orbit(&corrected.local, corrected.error).ok()
}

/// Returns for each physical start the stable orbit that it reaches, provided it can be followed
/// and no earlier start reached it.
pub fn settled_orbits<H: ParametricModel>(
    family: &H,
    parameter: f64,
    starts: &[Vec<f64>],
    tolerance: f64,
) -> Vec<Option<Orbit>> {
    let none = vec![None; starts.len()];
    let Ok(setting) = family.at(parameter) else {
        return none;
    };
    if setting.kernel.plant.period_s().is_none() {
        return none;
    }
    let options = Recognition {
        max_cycles: MAX_CYCLES,
        ..Recognition::at(tolerance.max(RECOGNITION_TOLERANCE))
    };
    let recognizer = Recognizer {
        family,
        kernel: &setting.kernel,
        parameter,
        options,
    };
    let mut known: Vec<Arc<AttractingOrbit>> = Vec::new();
    let mut settled = |start: &Vec<f64>| {
        let end = recognizer.settle(start, &known);
        let candidate = end
            .orbit()
            .filter(|candidate| !known.iter().any(|known| known.is_same(candidate)))?;
        known.push(Arc::clone(candidate));
        Some(candidate.orbit.clone()).filter(|orbit| !orbit.multipliers.is_empty())
    };
    starts.iter().map(&mut settled).collect()
}
