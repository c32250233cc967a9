//! Random harvesters: contacts, energies, end and steady-state flag of a run against brute force. A
//! few in every run, many if environment variables request them.
//!
//! ```text
//! JOUNCE_DRAWN_RUNS=10000 cargo test --release -p jounce-analysis --test attractors many_random_runs -- --nocapture
//! ```
//!
//! `JOUNCE_DRAWN_FIRST` is the number of the first harvester, default 0. `JOUNCE_DRAWN_RESULTS` is a file
//! for the counts of each portion, from which an interrupted comparison continues.

mod campaign;
mod circuit;
mod differences;
mod graze;
mod independent;
mod law;
mod library;
mod settled;
mod system;
mod tally;
mod verdict;

/// Calls a function with the brute-force model of a system.
macro_rules! with_model {
    ($system:expr, $function:ident, $($argument:expr),*) => {
        match $system.modes.len() {
            1 => $function(&ReferenceModel::<1, 4>::of($system), $($argument),*),
            2 => $function(&ReferenceModel::<2, 6>::of($system), $($argument),*),
            3 => $function(&ReferenceModel::<3, 8>::of($system), $($argument),*),
            4 | 5 => $function(&ReferenceModel::<5, 12>::of($system), $($argument),*),
            _ => $function(&ReferenceModel::<8, 18>::of($system), $($argument),*),
        }
    };
}
use with_model;

use campaign::campaign;
use std::io::Write;
use std::path::Path;
use tally::Tally;

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{name} is `{text}`, no number"))
    })
}

#[test]
fn random_runs_agree_with_brute_force() {
    let tally = Tally::of(0, 300);
    eprintln!("{tally}");
    assert!(tally.disagree.is_empty(), "{tally}");
    assert!(tally.agree > 200, "{tally}");
}

#[test]
fn many_random_runs_agree_with_brute_force() {
    let Some(count) = number("JOUNCE_DRAWN_RUNS") else {
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: JOUNCE_DRAWN_RUNS gives the number of harvesters"
        );
        return;
    };
    let first = number("JOUNCE_DRAWN_FIRST").unwrap_or(0);
    let results = std::env::var("JOUNCE_DRAWN_RESULTS").ok();
    let disagree = campaign(first, count, results.as_deref().map(Path::new));
    assert!(
        disagree.is_empty(),
        "harvesters that disagree: {disagree:?}"
    );
}

/// Shows one harvester that disagrees.
#[test]
fn one_random_run_is_shown() {
    let Some(index) = number("JOUNCE_DRAWN_SHOW") else {
        return;
    };
    let drawn = system::drawn(index).unwrap();
    let (cycles, tolerance, graze) = (drawn.cycles, drawn.tolerance, drawn.graze);
    eprintln!("{:#?}\n{:?}", drawn.merged, drawn.start);
    eprintln!("{cycles} cycles, tolerance {tolerance:e}, {graze:?}");
    let start = independent::Start {
        physical: &drawn.start,
        drive: 1.0,
    };
    let own = independent::run(&drawn.merged, &start, drawn.cycles);
    eprintln!(
        "{:?}\n{:?}\n{:?}",
        own.contacts, own.contact_s, own.energies
    );
    eprintln!("{:?}\n{:?}", own.size, own.strobe);
    let ends = own.passages.iter().filter(|passage| !passage.begins);
    ends.for_each(|passage| eprintln!("brute force leaves {passage:?}"));
    let segments = library::run(&drawn).unwrap().result.trajectory;
    for p in 0..drawn.merged.stops.len() {
        let mut held = false;
        for segment in segments.segments() {
            let force = segment.forces.iter().find(|force| force.port == p);
            if force.is_some() != held {
                let (at, length, word) = (
                    segment.start_s,
                    segment.length_s,
                    if held { "leaves" } else { "holds" },
                );
                eprintln!("library {word} {p} {at:.15} {length:.3e} {force:?}");
            }
            held = force.is_some();
        }
    }
    let last = own.strobe.last().unwrap();
    for tolerance in [1e-16, 1e-15, 1e-13, 1e-12] {
        let other = independent::run_at(&drawn.merged, &start, cycles, tolerance);
        let distance = independent::distance(last, other.strobe.last().unwrap()) / own.size;
        eprintln!("brute force with {tolerance:e}: state {distance:.2e}");
    }
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let drawn = system::Drawn {
            tolerance,
            ..system::drawn(index).unwrap()
        };
        let library = library::run(&drawn).unwrap();
        let end = independent::energy_coordinates(&drawn.merged, &library.end);
        let distance = independent::distance(last, &end) / own.size;
        eprintln!(
            "tolerance {tolerance:e}: state {distance:.2e}, {:?}",
            library.result.work
        );
    }
    let library = library::run(&drawn).unwrap();
    let result = &library.result;
    eprintln!(
        "{:?}\n{:?}\n{:?}",
        library.contacts, result.stops, result.energies
    );
    eprintln!("{:?}\n{:?}", result.work, result.settlement);
}
