//! Options: their defaults, their help, and their names in the options of each question.

use clap::{Args, FromArgMatches};
use jounce::{
    BasinsOptions, BifurcationsOptions, BranchOptions, ContactOptions, ConvertOptions,
    DiagramOptions, EnsembleOptions, ExportOptions, FrfOptions, ImportOptions, MeasuredFrfOptions,
    MeasuredModesOptions, ModesOptions, NoiseOptions, PowerOptions, ReadOptions, ReproduceOptions,
    RestitutionOptions, RigOptions, RunOptions, SegmentsOptions, SpectraOptions, StudyOptions,
    SweepOptions, definitions,
};
use serde::Serialize;
use std::fmt::Debug;

/// Each option has a line of help, and is required or has a default that the command line accepts;
/// every field is an option.
fn check<O: Args + FromArgMatches + Default + Debug + PartialEq + Serialize>() {
    let matches = O::augment_args(clap::Command::new("options").no_binary_name(true))
        .mut_args(|argument| match argument.is_required_set() {
            true => argument.required(false).default_value(""),
            false => argument,
        })
        .try_get_matches_from([""; 0])
        .expect("the defaults are valid");
    assert_eq!(
        O::from_arg_matches(&matches).expect("options"),
        O::default()
    );
    let fields = serde_json::to_value(O::default()).expect("options are serialised");
    let mut names = Vec::new();
    for option in definitions::<O>() {
        assert!(option.help.len() > 10, "{}: no help", option.name);
        assert!(!option.argument.is_empty(), "{}: no argument", option.name);
        names.push(option.name);
    }
    assert_eq!(
        names,
        fields
            .as_object()
            .expect("fields")
            .keys()
            .cloned()
            .collect::<Vec<_>>()
    );
}

#[test]
fn options_have_help_and_valid_defaults() {
    check::<RunOptions>();
    check::<BasinsOptions>();
    check::<SweepOptions>();
    check::<EnsembleOptions>();
    check::<StudyOptions>();
    check::<ReadOptions>();
    check::<ConvertOptions>();
    check::<PowerOptions>();
    check::<SpectraOptions>();
    check::<MeasuredFrfOptions>();
    check::<MeasuredModesOptions>();
    check::<ModesOptions>();
    check::<ExportOptions>();
    check::<RestitutionOptions>();
    check::<ImportOptions>();
    check::<FrfOptions>();
    check::<NoiseOptions>();
    check::<ReproduceOptions>();
    check::<BranchOptions>();
    check::<BifurcationsOptions>();
    check::<DiagramOptions>();
    check::<ContactOptions>();
    check::<RigOptions>();
    check::<SegmentsOptions>();
}

#[test]
fn options_are_read_by_name_with_defaults_for_the_others() {
    let options: RunOptions = serde_json::from_str(r#"{"record_s": 0.5}"#).expect("options");
    assert_eq!(
        options,
        RunOptions {
            record_s: 0.5,
            ..Default::default()
        }
    );
    assert!(serde_json::from_str::<RunOptions>(r#"{"recrod_s": 0.5}"#).is_err());
}
