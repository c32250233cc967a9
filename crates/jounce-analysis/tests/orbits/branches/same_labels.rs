//! Labels do not depend on the tolerance, the largest step or the subdivision of the range. Where
//! two searches follow the same piece of a curve, each label of one is a label of the other, or
//! lies in a part that one of them lists as not proved.
//!
//! ```text
//! JOUNCE_DRAWN_SYSTEMS=40 cargo test --release -p jounce-analysis --test orbits labels_of_random -- --nocapture
//! ```

use super::label_comparison::Case;
use jounce_analysis::{Bifurcation, BranchKind};

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{name} is `{text}`, no number"))
    })
}

#[test]
#[ignore = "long: runs with ./test --long"]
fn labels_of_the_cases_of_these_tests_are_the_same_for_all_settings() {
    let cases: [&[(&str, &str)]; 12] = [
        &[],
        &[
            ("drive.shaker.amplitude", "\"80 N\""),
            ("circuit.load.resistance", "\"100 kohm\""),
            ("stop.tip.frame", "\"harvester.table\""),
        ],
        &[
            ("drive.shaker.amplitude", "\"100 N\""),
            ("modal.harvester.damping_ratio.1", "0.3"),
        ],
        &[("stop.tip.gap", "\"0 mm\"")],
        &[
            ("stop.tip.gap", "\"3 mm\""),
            ("drive.shaker.amplitude", "\"100 N\""),
        ],
        &[("stop.tip.gap", "\"-0.2 mm\"")],
        &[("stop.tip.gap", "\"500 mm\"")],
        &[("stop.tip.stiffness", "\"100 N/m^1.5\"")],
        &[("circuit.load.resistance", "\"10 kohm\"")],
        &[
            ("drive.shaker.amplitude", "\"80 N\""),
            ("circuit.load.resistance", "\"100 kohm\""),
        ],
        &[
            ("drive.shaker.amplitude", "\"40 N\""),
            ("stop.tip.stiffness", "\"10000 N/m^1.5\""),
        ],
        &[("stop.tip.stiffness", "\"1e6 N/m^1.5\"")],
    ];
    // The first ones in every run, unless the environment variable gives another number.
    let requested = number("JOUNCE_DRAWN_SYSTEMS")
        .map(|count| (number("JOUNCE_DRAWN_FIRST").unwrap_or(0), count));
    let (first, count) = requested.unwrap_or((0, 5));
    let cases = cases
        .iter()
        .enumerate()
        .skip(first as usize)
        .take(count as usize);
    let missing_count: usize = cases
        .map(|(k, changes)| Case::of_bench(changes).check(&format!("case {k}")))
        .sum();
    assert_eq!(
        missing_count, 0,
        "labels that one search has and another lacks"
    );
}

/// Random harvesters of low cost: their motions at both ends of the range settle soon.
const QUICK: [u64; 6] = [1, 10, 12, 14, 17, 19];

#[test]
#[ignore = "long: runs with ./test --long"]
fn labels_of_random_harvesters_are_the_same_for_all_settings() {
    let requested = number("JOUNCE_DRAWN_SYSTEMS").map(|count| {
        let first = number("JOUNCE_DRAWN_FIRST").unwrap_or(0);
        (first..first + count).collect()
    });
    let indices: Vec<u64> = requested.unwrap_or_else(|| QUICK.to_vec());
    let missing_count: usize = indices
        .into_iter()
        .map(|index| Case::random(index).check(&format!("drawn {index}")))
        .sum();
    assert_eq!(
        missing_count, 0,
        "labels that one search has and another lacks"
    );
}

/// Between 2.2222 and 2.2241 Hz the branch turns five times. At a tolerance of 1e-9 a step leads past
/// these turns, and Newton's method finds no orbit half-way; a shorter step decides.
#[test]
#[ignore = "long: runs with ./test --long"]
fn turns_between_the_ends_of_a_step_are_followed() {
    let case = Case::random(31);
    let [coarse, fine] = [1e-9, 1e-10].map(|tolerance| {
        let labels = case.labels(tolerance);
        let is_turn = |label: &&Bifurcation| {
            label.kind == BranchKind::Fold && (2.222..2.225).contains(&label.at.parameter)
        };
        (labels.iter().filter(is_turn).count(), labels.len())
    });
    assert_eq!(coarse, fine);
    assert!(fine.0 >= 4, "{} turns", fine.0);
}
