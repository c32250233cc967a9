//! Comparisons on random harvesters: a few in every run, many if environment variables request
//! them.
//!
//! ```text
//! JOUNCE_DRAWN_SYSTEMS=60 JOUNCE_DRAWN_STARTS=400 cargo test --release -p jounce-analysis --test attractors many_random -- --nocapture
//! ```
//!
//! `JOUNCE_DRAWN_FIRST` is the number of the first harvester, default 0; `JOUNCE_DRAWN_CYCLES` the
//! cycles after which a motion is not periodic, default 20,000. `JOUNCE_DRAWN_RESULTS` is a folder
//! for the brute-force result of each start, from which an interrupted comparison continues; delete it
//! after a change of brute force or of the random harvesters. `JOUNCE_DRAWN_STORE=1` writes the endings
//! of 400 starts to the folder `stored`, from which the comparison then reads them.

use crate::agreement::{Verdict, compare, physical};
use crate::brute::{Patience, STEP_TOLERANCE};
use crate::endings::{Effort, endings};
use crate::random_specs::random_spec;
use crate::stored;
use jounce_analysis::{Cloud, InitialStates, Model};
use jounce_spec::SpecFile;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Seed of the harvesters.
pub const SEED: u64 = 22;

/// Starts of a cloud for which endings are stored.
pub const STARTS: usize = 400;

/// Limits of the stored integrations.
const PATIENCE: Patience = Patience {
    cycles: 20_000,
    period: 64,
};

pub fn number(name: &str) -> Option<usize> {
    std::env::var(name).ok().map(|text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{name} is `{text}`, no number"))
    })
}

pub fn cloud(starts: usize) -> InitialStates {
    InitialStates::Cloud(Cloud {
        starts,
        seed: 5,
        spread: 3.0,
    })
}

/// Random harvesters of low cost: their motions settle within some hundred cycles. Neither the
/// library nor brute force classifies any of them as chaos or a torus.
const QUICK: [u64; 6] = [8, 15, 18, 20, 25, 26];

#[test]
fn a_few_random_harvesters_end_where_brute_force_ends() {
    for index in QUICK {
        let agreement = compare(
            &SpecFile::from_text(random_spec(SEED, index)),
            cloud(40),
            &Effort::new(
                Patience {
                    cycles: 4000,
                    period: 64,
                },
                STEP_TOLERANCE,
            ),
        );
        eprint!("{index:3} {agreement}");
        assert!(
            agreement.count(Verdict::Different) == 0,
            "harvester {index}: {agreement}"
        );
        assert!(
            agreement.count(Verdict::Same) >= 38,
            "harvester {index}: {agreement}"
        );
        assert_eq!(
            agreement.attractors()[0],
            agreement.attractors()[1],
            "harvester {index}: {agreement}"
        );
        assert_eq!(
            agreement.same_starts[0], agreement.same_starts[1],
            "harvester {index}: {agreement}"
        );
    }
}

/// Three starts of harvester 32 pass an orbit at 0.84 to 0.93 of the largest radius at which the
/// examined directions contract, approach it for a few cycles, and end on the other one.
#[test]
fn starts_that_only_pass_an_orbit_are_not_attributed_to_it() {
    let file = SpecFile::from_text(random_spec(SEED, 32));
    let effort = Effort {
        known: stored::read(32).expect("stored endings"),
        ..Effort::new(PATIENCE, STEP_TOLERANCE)
    };
    let agreement = compare(&file, cloud(STARTS), &effort);
    assert_eq!(agreement.count(Verdict::Same), STARTS, "{agreement}");
}

/// File for the result of each start of a harvester, if a folder for them is given.
fn results(index: usize) -> Option<PathBuf> {
    let folder = std::env::var("JOUNCE_DRAWN_RESULTS").ok()?;
    Some(Path::new(&folder).join(format!("harvester-{index}.txt")))
}

/// Writes the stored endings of `JOUNCE_DRAWN_SYSTEMS` harvesters, if `JOUNCE_DRAWN_STORE` is set.
#[test]
fn endings_are_stored_on_request() {
    if std::env::var("JOUNCE_DRAWN_STORE").is_err() {
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: JOUNCE_DRAWN_STORE asks for the stored endings"
        );
        return;
    }
    let first = number("JOUNCE_DRAWN_FIRST").unwrap_or(0);
    for index in first..first + number("JOUNCE_DRAWN_SYSTEMS").unwrap_or(1) {
        let file = SpecFile::from_text(random_spec(SEED, index as u64));
        let model = Model::new(file.spec().unwrap()).unwrap();
        let plant = &model.kernel.plant;
        let mut effort = Effort::new(PATIENCE, STEP_TOLERANCE);
        effort.results = results(index);
        let starts = physical(plant, &cloud(STARTS));
        stored::write(index, &endings(&plant.system, &starts, &effort));
    }
}

#[test]
fn many_random_harvesters_end_where_brute_force_ends() {
    let Some(systems) = number("JOUNCE_DRAWN_SYSTEMS") else {
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: JOUNCE_DRAWN_SYSTEMS gives the number of harvesters"
        );
        return;
    };
    let (starts, first) = (
        number("JOUNCE_DRAWN_STARTS").unwrap_or(STARTS),
        number("JOUNCE_DRAWN_FIRST").unwrap_or(0),
    );
    let patience = Patience {
        cycles: number("JOUNCE_DRAWN_CYCLES").unwrap_or(PATIENCE.cycles),
        ..PATIENCE
    };
    let mut effort = Effort::new(patience, STEP_TOLERANCE);
    let mut failures = Vec::new();
    let (mut checked, mut inside) = (0, 0);
    for index in first..first + systems {
        let file = SpecFile::from_text(random_spec(SEED, index as u64));
        effort.results = results(index);
        if patience == PATIENCE {
            effort.known = stored::read(index).unwrap_or_default();
        }
        let agreement = compare(&file, cloud(starts), &effort);
        eprint!("{index:3} {agreement}");
        checked += agreement.other_starts[0];
        inside += agreement.other_starts[1];
        if agreement.count(Verdict::Different) > 0
            || agreement.attractors()[0] != agreement.attractors()[1]
        {
            failures.push(index);
        }
    }
    eprintln!("shares of other starts in their intervals: {inside} of {checked}");
    assert!(
        failures.is_empty(),
        "harvesters with other attractors or starts attributed wrongly: {failures:?}"
    );
}
