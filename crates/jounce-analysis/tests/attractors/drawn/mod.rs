//! Random harvesters: contacts, energies, end and steady-state flag of a run against brute force. A
//! few in every run, many if environment variables request them.
//!
//! ```text
//! JOUNCE_DRAWN_RUNS=10000 cargo test --release -p jounce-analysis --test attractors many_random_runs -- --nocapture
//! ```
//!
//! `JOUNCE_DRAWN_FIRST` is the number of the first harvester, default 0. `JOUNCE_DRAWN_RESULTS` is a file
//! for the counts of each portion, from which an interrupted comparison continues. `JOUNCE_DRAWN_SHOW` is
//! the number of a harvester that `one_random_run_is_shown` prints with both runs.

mod campaign;
mod circuit;
mod differences;
mod graze;
mod independent;
mod law;
mod library;
mod settled;
mod show;
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
use show::show;
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
    let tally = Tally::of(0, 150);
    eprintln!("{tally}");
    assert!(tally.disagree.is_empty(), "{tally}");
    assert!(tally.agree > 130, "{tally}");
}

/// Harvesters that disagreed, or were slow, before a defect was mended.
const MENDED: [u64; 9] = [260, 319, 647, 936, 1290, 1549, 1783, 1828, 1999];

#[test]
fn mended_runs_agree_with_brute_force() {
    for index in MENDED {
        let tally = Tally::of(index, 1);
        assert!(tally.disagree.is_empty(), "{tally}");
    }
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

#[test]
fn one_random_run_is_shown() {
    if let Some(index) = number("JOUNCE_DRAWN_SHOW") {
        show(index);
    }
}
