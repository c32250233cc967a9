//! Options of the quantities of studies: the names and defaults are those of the questions.

use jounce::parts::SweepOrder;
use jounce::{
    BasinsOptions, BifurcationsOptions, BranchOptions, DiagramOptions, EnsembleOptions,
    SweepOptions, questions,
};
use jounce_analysis::Recognition;
use jounce_analysis::study::{Quantity, Study};
use jounce_spec::SpecFile;
use std::path::Path;

const SPEC: &str = include_str!("../../../../examples/impact-harvester-2019/harvester.toml");
const OVER: &str = "drive.shaker.frequency=10Hz:14Hz:1Hz";

/// Reads the quantity of a study with the options that are required, and no other.
fn quantity(command: &str, required: &str) -> Quantity {
    let text = format!(
        "[vary]\n\"mass.table.mass\" = \"10 kg\"\n[quantity]\ncommand = \"{command}\"\n{required}"
    );
    let study = Study::with_spec(SpecFile::from_text(SPEC), Path::new(""), &text);
    study.expect("the study is valid").quantity
}

#[test]
fn every_quantity_has_the_options_of_its_question() {
    for question in questions() {
        let Some(command) = question.quantity else {
            continue;
        };
        for name in Quantity::options(command) {
            // The number of modes is the number of columns of the table.
            let is_known = (command, *name) == ("modes", "count")
                || question
                    .options
                    .iter()
                    .any(|option| option.keyword() == *name);
            assert!(is_known, "{command}: {name} is no option of the question");
        }
    }
}

#[test]
fn a_sweep_in_a_study_has_the_options_of_a_sweep() {
    let options = SweepOptions::default();
    let Quantity::Sweep {
        direction,
        fixed_duration,
        ..
    } = quantity("sweep", &format!("over = \"{OVER}\""))
    else {
        panic!("the quantity is no sweep");
    };
    assert_eq!(direction, options.direction.into());
    assert_eq!(fixed_duration, options.fixed_duration);
    for (word, order) in [
        ("up", SweepOrder::Up),
        ("down", SweepOrder::Down),
        ("both", SweepOrder::Both),
        ("independent", SweepOrder::Independent),
    ] {
        let required = format!("over = \"{OVER}\"\ndirection = \"{word}\"");
        let Quantity::Sweep { direction, .. } = quantity("sweep", &required) else {
            panic!("the quantity is no sweep");
        };
        assert_eq!(direction, order.into());
    }
}

#[test]
fn basins_in_a_study_have_the_options_of_basins() {
    let options = BasinsOptions::default();
    let expected = Quantity::Basins {
        starts: options.starts,
        seed: options.seed,
        spread: options.spread,
        recognition: Recognition {
            longest_period: options.longest_period,
            max_cycles: options.max_cycles,
            ..Recognition::at(options.tolerance)
        },
    };
    assert_eq!(quantity("basins", ""), expected);
}

#[test]
fn an_ensemble_in_a_study_has_the_options_of_an_ensemble() {
    let options = EnsembleOptions::default();
    let expected = Quantity::Ensemble {
        members: options.members,
        seed: options.seed,
    };
    assert_eq!(quantity("ensemble", ""), expected);
}

#[test]
fn branches_in_a_study_have_the_defaults_of_branches() {
    let options = BranchOptions::default();
    let required = "over = \"drive.shaker.frequency=4Hz:20Hz\"";
    let Quantity::Branch {
        seeds,
        longest_period,
        tolerance,
        ..
    } = quantity("branch", required)
    else {
        panic!("the quantity is no branch");
    };
    assert_eq!(
        (seeds, longest_period, tolerance),
        (options.seeds, options.longest_period, options.tolerance)
    );
}

#[test]
fn bifurcations_in_a_study_have_the_defaults_of_bifurcations() {
    let options = BifurcationsOptions::default();
    let required =
        "over = \"drive.shaker.frequency=4Hz:20Hz\"\nagainst = \"stop.tip.gap=0.5mm:1.5mm\"";
    let Quantity::Bifurcations {
        seeds,
        longest_period,
        tolerance,
        ..
    } = quantity("bifurcations", required)
    else {
        panic!("the quantity is no bifurcation curve");
    };
    assert_eq!(
        (seeds, longest_period, tolerance),
        (options.seeds, options.longest_period, options.tolerance)
    );
}

#[test]
fn a_diagram_in_a_study_has_the_defaults_of_a_diagram() {
    let Quantity::Diagram { tolerance, .. } = quantity("diagram", &format!("over = \"{OVER}\""))
    else {
        panic!("the quantity is no diagram");
    };
    assert_eq!(tolerance, DiagramOptions::default().tolerance);
}
