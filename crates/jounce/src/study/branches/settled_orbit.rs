//! From a start to the periodic orbit that the march settles on.

use super::candidate::Candidate;
use crate::continuation::{Corrected, Corrector, Metric, Position, settle};
use crate::march::{Kernel, Marcher};
use crate::orbit::{Harvester, Orbit, OrbitMethod, Shooting};

/// Drive cycles marched before an orbit is looked for.
const CYCLES: u32 = 60;

/// Times that the march goes on when no orbit is found.
const ATTEMPTS: u32 = 48;

/// Longest period looked for, drive cycles.
const LONGEST: u32 = 12;

/// Change over a period, beside the size of the state, that is roundoff of a motion that repeats itself.
const REPEATS: f64 = 1e-9;

/// Change over a period, beside the size of the state, of a motion that rests on a rigid stop and has settled: how it came to rest is
/// forgotten, so that the change is what other modes still do.
const RESTED: f64 = 1e-8;

/// How much better the motion must close over a longer period than over every shorter one.
const CLEARLY: f64 = 0.5;

/// Farthest that an orbit may be, beside the size of the state, to be looked at.
const NEAR: f64 = 0.1;

/// How much better the motion must close over a longer period than over one of which an orbit is found: a transient that turns about
/// an orbit closes over many a period by chance.
const MUCH_CLEARER: f64 = 0.1;

/// A stable orbit near where the march from `start` (physical) settles, one that can be followed: it does not rest on a rigid stop. `None`
/// when the march stays away from every orbit that is looked for.
pub fn settled_orbit<H: Harvester>(harvester: &H, parameter: f64, start: &[f64], tolerance: f64, goal: f64) -> Option<Orbit> {
    settled_motion(harvester, parameter, start, tolerance, goal).filter(|orbit| !orbit.multipliers.is_empty())
}

/// The same, or the motion that comes to rest on a rigid stop in each period: without multipliers.
pub fn settled_motion<H: Harvester>(harvester: &H, parameter: f64, start: &[f64], tolerance: f64, goal: f64) -> Option<Orbit> {
    let setting = harvester.at(parameter).ok()?;
    let kernel: &Kernel = &setting.kernel;
    let cycle_s = kernel.plant.period_s()?;
    let mut y = kernel.plant.from_physical(start, 0.0);
    let mut candidate: Option<Candidate> = None;
    for _ in 0..ATTEMPTS {
        let (looks, rests) = looks(kernel, &y, cycle_s, tolerance.max(1e-8))?;
        y = looks.last()?.clone();
        let size = norm(looks[0].iter().copied()).max(norm(kernel.plant.steady_at(0.0).into_iter()));
        let distance = |cycles: u32| norm(looks[0].iter().zip(&looks[cycles as usize]).map(|(a, b)| a - b)) / size;
        let mut before = candidate.take();
        if rests {
            if let Some(cycles) = (1..=LONGEST).find(|cycles| distance(*cycles) < RESTED) {
                let shooting = Shooting::new(harvester, kernel, cycles, tolerance);
                return shooting.marched_orbit(&kernel.plant.to_physical(&looks[0], 0.0), parameter).ok();
            }
            continue;
        }
        let (periods, closest) = periods(distance);
        let scale = Shooting::new(harvester, kernel, 1, tolerance);
        let at = |cycle: u32| scale.unknown(&kernel.plant.to_physical(&looks[cycle as usize], 0.0));
        let now = at(0);
        let tells = |known: &Candidate, cycles: u32| known.tells([&now, &at(cycles)], cycles);
        let tells_all = |known: &Candidate| periods.iter().all(|cycles| *cycles <= known.orbit.period_cycles || tells(known, *cycles));
        if before.as_mut().is_some_and(|known| tells_all(known) && known.is_approached(&now)) {
            candidate = before;
        } else {
            let state = kernel.plant.to_physical(&looks[0], 0.0);
            let mut found: Option<Candidate> = None;
            for cycles in &periods {
                let by_chance = |shorter: &Candidate| distance(*cycles) > MUCH_CLEARER * distance(shorter.orbit.period_cycles);
                if found.as_ref().is_some_and(|shorter| by_chance(shorter) || tells(shorter, *cycles)) {
                    continue;
                }
                let Some(next) = candidate_near(harvester, kernel, parameter, &state, (*cycles, tolerance, goal)) else { continue };
                found = Some(match found {
                    Some(shorter) => shorter.or(next),
                    None => next,
                });
            }
            if found.is_none() && closest < REPEATS {
                // It repeats itself and is no orbit that shooting can have.
                return None;
            }
            candidate = found.map(|found| found.after(before));
        }
        if candidate.as_ref().is_some_and(Candidate::is_certain) {
            break;
        }
    }
    candidate.filter(Candidate::is_certain).map(|candidate| candidate.orbit)
}

/// States at the ends of the last cycles of a march, and whether it rests on a rigid stop over them.
fn looks(kernel: &Kernel, y: &[f64], cycle_s: f64, tolerance: f64) -> Option<(Vec<Vec<f64>>, bool)> {
    let mut looks = Vec::new();
    let mut marcher = Marcher::new(kernel, y, 0.0, tolerance).ok()?;
    for cycle in 1..=CYCLES + LONGEST {
        marcher.advance_to(f64::from(cycle) * cycle_s).ok()?;
        if cycle >= CYCLES {
            looks.push(marcher.state());
        }
        if cycle == CYCLES {
            marcher.reset_statistics();
        }
    }
    Some((looks, marcher.statistics().sticking_s != 0.0))
}

/// Periods over which the motion closes clearly better than over every shorter one, and how well it closes at best.
fn periods(distance: impl Fn(u32) -> f64) -> (Vec<u32>, f64) {
    let mut closest = f64::INFINITY;
    let periods = (1..=LONGEST).filter(|cycles| {
        let here = distance(*cycles);
        let closes = here < CLEARLY * closest;
        closest = closest.min(here);
        // A long period costs more to look at, and more of it closes by chance.
        closes && here * f64::from(*cycles) < NEAR
    });
    (periods.collect(), closest)
}

/// The stable orbit of some cycles that Newton finds near a physical state.
fn candidate_near<H: Harvester>(
    harvester: &H,
    kernel: &Kernel,
    parameter: f64,
    state: &[f64],
    (cycles, tolerance, goal): (u32, f64, f64),
) -> Option<Candidate> {
    let shooting = Shooting::new(harvester, kernel, cycles, tolerance).charged_as(state);
    let position = Position { unknown: shooting.unknown(state), parameter };
    let metric = Metric::at(&position, 1.0);
    let Corrected { position: there, local: shot, error, .. } =
        settle(&shooting, &Corrector { goal, most: 12 }, &metric, position.clone()).ok()?;
    let distance = metric.length(&position.to(&there));
    let orbit = shooting.orbit(&shot, error).ok()?;
    // Cycles that repeat belong to a shorter orbit, which has a turn of its own. A Newton that runs far has found another orbit than the one that attracts.
    (distance < NEAR && orbit.is_stable() && !orbit.repeats_early()).then(|| Candidate::new(orbit, distance, shot.map().clone()))
}

fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}
