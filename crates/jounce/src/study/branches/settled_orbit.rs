//! From a start to the periodic orbit that the march settles on.

use crate::continuation::{Corrector, Metric, Position, settle};
use crate::march::{Kernel, Marcher};
use crate::orbit::{Harvester, Orbit, OrbitMethod, Shooting};

/// Drive cycles marched before an orbit is looked for.
const CYCLES: u32 = 60;

/// Times that the march goes on when no orbit is found.
const ATTEMPTS: u32 = 48;

/// Longest period looked for, drive cycles.
const LONGEST: u32 = 12;

/// Times in a row that the march must come nearer to an orbit to be taken as drawn to it: a transient passes by others on its way.
const NEARER: u32 = 2;

/// Distance from the orbit, beside the size of the state, that needs no such proof.
const THERE: f64 = 1e-6;

/// Change over a period, beside the size of the state, that is roundoff of a motion that repeats itself.
const REPEATS: f64 = 1e-9;

/// Change over a period, beside the size of the state, of a motion that rests on a rigid stop and has settled: how it came to rest is
/// forgotten, so that the change is what other modes still do.
const RESTED: f64 = 1e-8;

/// Farthest that an orbit may be, beside the size of the state, to be looked at.
const NEAR: f64 = 0.1;

/// Change over a period, beside the distance from an orbit of a shorter one, of a motion that is drawn to another orbit.
const OTHER: f64 = 0.1;

/// How much nearer a longer period must come than a shorter one.
const CLEARLY: f64 = 0.5;

/// A stable orbit that the march is drawn to.
struct Candidate {
    orbit: Orbit,
    distance: f64,
    nearer: u32,
}

impl Candidate {
    /// The next one found, after the one before.
    fn after(before: Option<Candidate>, orbit: Orbit, distance: f64) -> Self {
        let same = |known: &Orbit| {
            known.period_cycles == orbit.period_cycles && (known.mean_power_w - orbit.mean_power_w).abs() <= 1e-5 * orbit.mean_power_w.abs()
        };
        let nearer = before.filter(|before| same(&before.orbit) && distance < before.distance).map_or(0, |before| before.nearer + 1);
        Self { orbit, distance, nearer }
    }

    /// Whether a march has clearly come nearer to it, as its state (energy coordinates) after further cycles tells, at whichever cycle of
    /// the orbit that is; `longer` is the least change over a longer period. Where it has not, or where a longer period closes so well
    /// that it may be another orbit close by, Newton has to find an orbit anew.
    fn is_approached(&mut self, state: &[f64], longer: f64) -> bool {
        let apart = |look: &Vec<f64>| norm(look.iter().zip(state).map(|(a, b)| a - b));
        let nearest = self.orbit.looks.iter().map(apart).fold(f64::INFINITY, f64::min);
        let distance = nearest / norm(state.iter().copied());
        let nearer = distance < THERE || (distance < CLEARLY * self.distance && longer > OTHER * distance);
        if nearer {
            (self.distance, self.nearer) = (distance, self.nearer + 1);
        }
        nearer
    }

    fn is_certain(&self) -> bool {
        self.nearer >= NEARER || self.distance < THERE
    }
}

/// A stable orbit near where the march from `start` (physical) settles, one that can be followed: it does not rest on a rigid stop. `None`
/// when the march stays away from every orbit that is looked for.
pub fn settled_orbit<H: Harvester>(harvester: &H, parameter: f64, start: &[f64], tolerance: f64, goal: f64) -> Option<Orbit> {
    settled_motion(harvester, parameter, start, tolerance, goal).filter(|orbit| !orbit.multipliers.is_empty())
}

/// The same, or the motion that comes to rest on a rigid stop in each period: without multipliers.
pub fn settled_motion<H: Harvester>(harvester: &H, parameter: f64, start: &[f64], tolerance: f64, goal: f64) -> Option<Orbit> {
    let setting = harvester.at(parameter).ok()?;
    let kernel: &Kernel = &setting.kernel;
    let cycle_s = std::f64::consts::TAU / kernel.plant.tones.first()?.angular_frequency_rad_s;
    let mut y = kernel.plant.from_physical(start, 0.0);
    let mut candidate: Option<Candidate> = None;
    for _ in 0..ATTEMPTS {
        let mut looks = Vec::new();
        let mut marcher = Marcher::new(kernel, &y, 0.0, tolerance.max(1e-8)).ok()?;
        for cycle in 1..=CYCLES + LONGEST {
            marcher.advance_to(f64::from(cycle) * cycle_s).ok()?;
            if cycle >= CYCLES {
                looks.push(marcher.state());
            }
            if cycle == CYCLES {
                marcher.reset_statistics();
            }
        }
        y = looks.last()?.clone();
        let size = norm(looks[0].iter().copied()).max(norm(kernel.plant.steady_at(0.0).into_iter()));
        let distance = |cycles: u32| norm(looks[0].iter().zip(&looks[cycles as usize]).map(|(a, b)| a - b)) / size;
        let mut before = candidate.take();
        if marcher.statistics().sticking_s != 0.0 {
            if let Some(cycles) = (1..=LONGEST).find(|cycles| distance(*cycles) < RESTED) {
                let shooting = Shooting::new(harvester, kernel, cycles, tolerance);
                return shooting.marched_orbit(&kernel.plant.to_physical(&looks[0], 0.0), parameter).ok();
            }
            continue;
        }
        let state = kernel.plant.to_physical(&looks[0], 0.0);
        let unknown = Shooting::new(harvester, kernel, 1, tolerance).unknown(&state);
        let longer = |candidate: &Candidate| (candidate.orbit.period_cycles + 1..=LONGEST).map(distance).fold(f64::INFINITY, f64::min);
        let least = before.as_ref().map_or(0.0, longer);
        if before.as_mut().is_some_and(|before| before.is_approached(&unknown, least)) {
            candidate = before;
            if candidate.as_ref().is_some_and(Candidate::is_certain) {
                break;
            }
            continue;
        }
        // Periods over which the motion closes clearly better than over every shorter one.
        let mut closest = f64::INFINITY;
        let periods = (1..=LONGEST).filter(|cycles| {
            let here = distance(*cycles);
            let closes = here < CLEARLY * closest;
            closest = closest.min(here);
            closes && here < NEAR
        });
        let near = |cycles: u32| orbit_near(harvester, kernel, parameter, &state, (cycles, tolerance, goal));
        let found: Vec<(Orbit, f64)> = periods.filter_map(near).collect();
        if found.is_empty() && closest < REPEATS {
            // It repeats itself and is no orbit that shooting can have.
            return None;
        }
        let nearest = found.into_iter().reduce(|short, long| if long.1 < CLEARLY * short.1 { long } else { short });
        candidate = nearest.map(|(orbit, distance)| Candidate::after(before, orbit, distance));
        if candidate.as_ref().is_some_and(Candidate::is_certain) {
            break;
        }
    }
    candidate.filter(Candidate::is_certain).map(|candidate| candidate.orbit)
}

/// The stable orbit of some cycles that Newton finds near a physical state, and its distance beside the size of the state.
fn orbit_near<H: Harvester>(
    harvester: &H,
    kernel: &Kernel,
    parameter: f64,
    state: &[f64],
    (cycles, tolerance, goal): (u32, f64, f64),
) -> Option<(Orbit, f64)> {
    let shooting = Shooting::new(harvester, kernel, cycles, tolerance).charged_as(state);
    let position = Position { unknown: shooting.unknown(state), parameter };
    let metric = Metric::at(&position, 1.0);
    let found = settle(&shooting, &Corrector { goal, most: 12 }, &metric, position.clone()).ok()?;
    let distance = metric.length(&position.to(&found.position));
    let orbit = shooting.orbit(&found.local, found.error).ok()?;
    // Cycles that repeat belong to a shorter orbit, which has a turn of its own. A Newton that runs far has found another orbit than the one that attracts.
    (distance < NEAR && orbit.is_stable() && !orbit.repeats_early()).then_some((orbit, distance))
}

fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}
