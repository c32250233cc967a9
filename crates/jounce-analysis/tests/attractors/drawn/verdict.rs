//! Comparison of one harvester.

use super::graze::Graze;
use super::independent::{self, Run, Start, chatter_m_s, contact_shift_s, distance, run};
use super::library::{self, LibraryRun};
use super::settled::{Flag, flag, repeats};
use super::system::Drawn;

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

/// Residual of the energy balance of brute force, relative to the largest energy.
const OWN_BALANCE: f64 = 1e-9;

/// Depth, relative to the motion, from which a first contact must be found: ten times that of the
/// certificate.
const CERTAIN_DEPTH: f64 = 1e-11;

/// Verdict on one harvester.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    Agree,
    /// The perturbation changes the list of contacts.
    Grazing,
    /// The perturbation changes the end of the motion by more than [`SENSITIVE`], or brute force
    /// ends early.
    Sensitive,
    /// The distance to the orbit is the limit of the flag within a tenth.
    Limit,
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
    /// True where the first contact of a stop at a peak was checked.
    pub peak: bool,
    pub settled: bool,
}

/// Bounds of a comparison.
struct Bounds {
    /// Relative to the size of the motion and to the largest energy.
    state: f64,
    energy: f64,
    /// Shift of contacts, s.
    shift_s: f64,
    residual: f64,
}

/// Compares the library with brute force on one harvester.
pub fn compare(drawn: &Drawn) -> Comparison {
    let base = Start {
        physical: &drawn.start,
        drive: 1.0,
    };
    let own = run(&drawn.merged, &base, drawn.cycles);
    let mut comparison = Comparison {
        verdict: Verdict::Agree,
        contacts: own.contacts.iter().map(Vec::len).sum(),
        ratio: 0.0,
        peak: false,
        settled: false,
    };
    let library = match library::run(drawn) {
        Ok(library) => library,
        Err(reason) => {
            comparison.verdict = Verdict::Refused(reason);
            return comparison;
        }
    };
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
        Ok(bounds) => match differences(drawn, &own, &library, &bounds) {
            Err(message) => Verdict::Disagree(message),
            Ok(ratio) => {
                comparison.ratio = ratio;
                settled(drawn, &own, &library, &mut comparison.settled)
            }
        },
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
        residual: 0.1 * STEPS * steps * drawn.tolerance,
    })
}

fn last(run: &Run) -> &[f64] {
    run.strobe.last().map_or(&[], Vec::as_slice)
}

/// Largest ratio of a difference to its bound, or a message on the first one above it.
fn differences(
    drawn: &Drawn,
    own: &Run,
    library: &LibraryRun,
    bounds: &Bounds,
) -> Result<f64, String> {
    let mut largest = 0.0_f64;
    let mut check = |name: &str, difference: f64, bound: f64| {
        largest = largest.max(difference / bound);
        // Also where the difference is not a number.
        if difference <= bound {
            Ok(())
        } else {
            Err(format!("{name}: {difference:.3e} above {bound:.3e}"))
        }
    };
    let (energies, scale_j) = (&library.result.energies, library.result.energies.scale_j);
    if scale_j == 0.0 {
        return Ok(0.0);
    }
    let own_residual = own.energies.residual_j().abs() / scale_j;
    check(
        "balance of brute force",
        own_residual,
        OWN_BALANCE.max(bounds.energy),
    )?;
    for (p, stop) in drawn.merged.stops.iter().enumerate() {
        let (ours, theirs) = (&own.contacts[p], &library.contacts[p]);
        let shift = contact_shift_s(ours, theirs, chatter_m_s(&stop.law, ours));
        check(
            &format!(
                "contacts of {}, {} and {}",
                stop.name,
                ours.len(),
                theirs.len()
            ),
            shift,
            bounds.shift_s,
        )?;
        if let Some(own_s) = own.contact_s[p] {
            let result = &library.result.stops[p];
            let cycle_s = drawn.merged.drives[0].frequency_hz.recip();
            let their_s = result.contact_duty * drawn.cycles as f64 * cycle_s;
            let count = 1.0 + ours.len() as f64;
            check(
                &format!("time in contact of {}", stop.name),
                (own_s - their_s).abs(),
                count * bounds.shift_s,
            )?;
        }
        let reported = library.result.stops[p].contacts as usize;
        let from_start = reported.saturating_sub(theirs.len());
        check(
            &format!(
                "{reported} contacts of {} reported, {} recorded",
                stop.name,
                theirs.len()
            ),
            if reported < theirs.len() {
                f64::INFINITY
            } else {
                from_start as f64
            },
            1.0,
        )?;
    }
    let end = independent::energy_coordinates(&drawn.merged, &library.end);
    check("state", distance(last(own), &end) / own.size, bounds.state)?;
    if !library.result.is_trivial() {
        check(
            "residual",
            energies.residual_relative().abs(),
            bounds.residual,
        )?;
    }
    let theirs = [
        energies.input_j,
        energies.loads_j.iter().sum(),
        energies.leaks_j.iter().sum(),
        energies.damping_j,
        energies.contact_loss_j,
        energies.stored_j,
    ];
    for ((name, ours), theirs) in own.energies.list().into_iter().zip(theirs) {
        check(name, (ours - theirs).abs() / scale_j, bounds.energy)?;
    }
    Ok(largest)
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
