//! Options of the quantities of studies: the names and defaults are those of the questions.

use clap::Args;
use jounce::{BasinsOptions, EnsembleOptions, SweepOptions, SweepOrder, definitions};
use jounce_core::analysis::Recognition;
use jounce_core::spec::SpecFile;
use jounce_core::study::{Quantity, Study};
use std::path::Path;

const SPEC: &str = include_str!("../../../examples/impact-harvester-2019/harvester.toml");
const OVER: &str = "drive.shaker.frequency=10Hz:14Hz:1Hz";

/// Reads the quantity of a study with the options that are required, and no other.
fn quantity(command: &str, required: &str) -> Quantity {
    let text = format!(
        "[vary]\n\"stop.tip.gap\" = \"1 mm\"\n[quantity]\ncommand = \"{command}\"\n{required}"
    );
    let study = Study::with_spec(SpecFile::from_text(SPEC), Path::new(""), &text);
    study.expect("the study is valid").quantity
}

/// Checks that each option of a command in a study is an option of the question.
fn check_names<O: Args>(command: &str) {
    let options = definitions::<O>();
    let names = Quantity::options(command);
    assert!(!names.is_empty(), "{command}: no options");
    for name in names {
        assert!(
            options.iter().any(|option| option.name == *name),
            "{command}: {name} is no option of the question"
        );
    }
}

#[test]
fn a_sweep_in_a_study_has_the_options_of_a_sweep() {
    check_names::<SweepOptions>("sweep");
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
    check_names::<BasinsOptions>("basins");
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
    check_names::<EnsembleOptions>("ensemble");
    let options = EnsembleOptions::default();
    let expected = Quantity::Ensemble {
        members: options.members,
        seed: options.seed,
    };
    assert_eq!(quantity("ensemble", ""), expected);
}
