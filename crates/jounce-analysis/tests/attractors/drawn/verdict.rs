//! Comparison of one harvester.

use super::differences::{Differences, last};
use super::graze::Graze;
use super::independent::{self, Run, Start, chatter_m_s, contact_shift_s, distance, run};
use super::library::{self, LibraryRun};
use super::settled::{Flag, flag, repeats};
use super::system::Drawn;
use std::time::Instant;

/// Perturbation of the start, in tolerances of the run, whose effect bounds the error of the
/// library.
const PERTURBATION: f64 = 10.0;

/// Factor on that effect.
const MARGIN: f64 = 10.0;

/// Effect of the perturbation, relative to the size of the motion, above which a motion is too
/// sensitive to be compared.
const SENSITIVE: f64 = 1e-4;

/// Shift of a contact, in drive cycles, by the perturbation above which a list of contacts counts as
/// changed.
const SHIFT: f64 = 1e-3;

/// Contact steps of a run with one tolerance of error; the error grows with their number.
const STEPS: f64 = 100.0;

/// Depth, relative to the motion, from which a first contact must be found: ten times that of the
/// certificate.
const CERTAIN_DEPTH: f64 = 1e-11;

/// Verdict on one harvester.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    Agree,
    /// The perturbation changes the list of contacts, or the lists differ and the point touches both of
    /// two opposite stops at once.
    Grazing,
    /// The perturbation changes the end of the motion by more than [`SENSITIVE`], or brute force
    /// ends early.
    Sensitive,
    /// The distance to the orbit is the limit of the flag within a tenth.
    Limit,
    /// Only the time in contact differs by more than its bound.
    Duration,
    /// The library refuses the harvester.
    Refused(String),
    Disagree(String),
}

/// Result of one comparison.
pub struct Comparison {
    pub verdict: Verdict,
    /// Contacts by brute force.
    pub contacts: usize,
    /// Largest ratio of a difference to its bound.
    pub ratio: f64,
    /// Residual of the energy balance, in tolerances of the largest energy.
    pub residual: f64,
    /// Largest relative difference of the time in contact.
    pub duration: f64,
    /// True where the first contact of a stop at a peak was checked.
    pub peak: bool,
    pub settled: bool,
    /// Wall time of one run by brute force and by the library, s.
    pub seconds: [f64; 2],
}

/// Bounds of a comparison.
pub struct Bounds {
    /// Relative to the size of the motion.
    pub state: f64,
    /// Relative to the largest energy.
    pub energy: f64,
    /// Shift of contacts, s.
    pub shift_s: f64,
    /// Tolerance of the run.
    pub tolerance: f64,
}

/// Compares the library with brute force on one harvester.
pub fn compare(drawn: &Drawn) -> Comparison {
    let base = Start {
        physical: &drawn.start,
        drive: 1.0,
    };
    let begin = Instant::now();
    let own = run(&drawn.merged, &base, drawn.cycles);
    let brute_s = begin.elapsed().as_secs_f64();
    let mut comparison = Comparison {
        verdict: Verdict::Agree,
        contacts: own.contacts.iter().map(Vec::len).sum(),
        ratio: 0.0,
        residual: 0.0,
        duration: 0.0,
        peak: false,
        settled: false,
        seconds: [brute_s, 0.0],
    };
    let begin = Instant::now();
    let library = match library::run(drawn) {
        Ok(library) => library,
        Err(verdict) => {
            comparison.verdict = verdict;
            return comparison;
        }
    };
    comparison.seconds[1] = begin.elapsed().as_secs_f64();
    if let Some(graze) = drawn.graze {
        match first_contact(drawn, graze, &own, &library) {
            None => {}
            Some(Ok(())) => comparison.peak = true,
            Some(Err(message)) => {
                comparison.verdict = Verdict::Disagree(message);
                return comparison;
            }
        }
    }
    comparison.verdict = match bounds(drawn, &own, &library) {
        Err(verdict) => verdict,
        Ok(bounds) => {
            let differences = Differences::of(drawn, &own, &library, &bounds);
            comparison.ratio = differences.ratio;
            comparison.residual = differences.residual;
            comparison.duration = differences.duration;
            match differences.messages.as_slice() {
                [] => settled(drawn, &own, &library, &mut comparison.settled),
                _ if differences.is_duration_only => Verdict::Duration,
                _ if drawn.has_no_play() => Verdict::Grazing,
                messages => Verdict::Disagree(messages.join("; ")),
            }
        }
    };
    comparison
}

/// Compares the first contact of a stop at a peak of the free motion; `None` where its depth is
/// within the certificate.
fn first_contact(
    drawn: &Drawn,
    graze: Graze,
    own: &Run,
    library: &LibraryRun,
) -> Option<Result<(), String>> {
    let cycle_s = drawn.merged.drives[0].frequency_hz.recip();
    let depth_m = graze.depth * graze.peak.displacement_m;
    let driven_m: f64 = drawn.plant.ports[0].steady_m.iter().map(|m| m.norm()).sum();
    if depth_m.abs() < CERTAIN_DEPTH * graze.peak.displacement_m.max(driven_m) {
        return None;
    }
    let searched_s = drawn.cycles.min(3) as f64 * cycle_s;
    let first = |contacts: &[Vec<independent::Contact>]| {
        let first = contacts[0].first().map(|contact| contact.time_s);
        first.filter(|time_s| *time_s < searched_s * (1.0 - 1e-9))
    };
    let (ours, theirs) = (first(&own.contacts), first(&library.contacts));
    let approach_s = (2.0 * depth_m.abs() / graze.peak.acceleration_m_s2.abs()).sqrt();
    let is_right = match (graze.depth > 0.0, ours, theirs) {
        (true, Some(a), Some(b)) => (a - b).abs() <= (0.2 * approach_s).max(1e-9 * cycle_s),
        (false, None, None) => true,
        _ => false,
    };
    Some(if is_right {
        Ok(())
    } else {
        Err(format!(
            "first contact at depth {:e}: brute force {ours:?}, library {theirs:?}, peak {}",
            graze.depth, graze.peak.time_s
        ))
    })
}

/// Bounds of the differences, from perturbed starts.
fn bounds(drawn: &Drawn, own: &Run, library: &LibraryRun) -> Result<Bounds, Verdict> {
    if own.is_lost {
        return Err(Verdict::Sensitive);
    }
    let part = PERTURBATION * drawn.tolerance;
    let cycle_s = drawn.merged.drives[0].frequency_hz.recip();
    let (mut state, mut energy, mut shift_s) = (part, part, part * cycle_s);
    let scale_j = library.result.energies.scale_j;
    let parts = if drawn.graze.is_some() {
        &[part, -part][..]
    } else {
        &[part]
    };
    for part in parts {
        let (physical, drive) = drawn.perturbed(own.size, *part);
        let start = Start {
            physical: &physical,
            drive,
        };
        let near = run(&drawn.merged, &start, drawn.cycles);
        for (p, stop) in drawn.merged.stops.iter().enumerate() {
            let chatter = chatter_m_s(&stop.law, &own.contacts[p]);
            let shift = contact_shift_s(&own.contacts[p], &near.contacts[p], chatter);
            if shift > SHIFT * cycle_s {
                return Err(Verdict::Grazing);
            }
            shift_s = shift_s.max(shift);
        }
        if near.is_lost {
            return Err(Verdict::Sensitive);
        }
        state = state.max(distance(last(own), last(&near)) / own.size);
        let pairs = own.energies.list().into_iter().zip(near.energies.list());
        let change_j = pairs.fold(0.0_f64, |max, (a, b)| max.max((a.1 - b.1).abs()));
        energy = energy.max(change_j / scale_j);
    }
    if state > SENSITIVE {
        return Err(Verdict::Sensitive);
    }
    let steps = (library.result.work.contact_steps as f64 / STEPS).max(1.0);
    Ok(Bounds {
        state: MARGIN * steps * state,
        energy: MARGIN * steps * energy,
        shift_s: MARGIN * steps * shift_s,
        tolerance: drawn.tolerance,
    })
}

/// Compares the flag of steady state.
fn settled(drawn: &Drawn, own: &Run, library: &LibraryRun, is_settled: &mut bool) -> Verdict {
    let Some(theirs) = library.result.settlement else {
        return Verdict::Disagree("no steady-state test".into());
    };
    *is_settled = theirs.settled;
    match flag(&own.strobe, drawn.tolerance) {
        Flag::Limit => Verdict::Limit,
        Flag::Settled(period) if theirs.settled && theirs.period_cycles as usize == period => {
            repeats(drawn, own, period).map_or(Verdict::Agree, Verdict::Disagree)
        }
        Flag::Not if !theirs.settled => Verdict::Agree,
        ours => Verdict::Disagree(format!(
            "steady state: brute force {ours:?}, library {theirs:?}"
        )),
    }
}
