//! The help of `jounce fit` and `jounce modes`, and its example.

use super::fits::SPEC;
use super::{jounce, outcome, program};

/// The example of `fit --help` is a file that can be fitted to: the damping ratio of the first mode follows its measurement, whose deviation of
/// 0.1 is small beside the 0.5 known before, so that it covers the share `0.5^2 / (0.5^2 + 0.1^2)` of the way, in logarithms.
#[test]
fn the_example_of_the_help_is_fitted() {
    let folder = tempfile::tempdir().unwrap();
    let (_, help, _) = outcome(program().args(["fit", "--help"]));
    let (_, example) = help.split_once("FEATURES, a small one:").unwrap();
    let (example, following_text) = example.split_once("Deviations are").unwrap();
    assert!(
        following_text.contains("measured.md") && following_text.contains("[[history]]"),
        "{following_text}"
    );
    std::fs::write(folder.path().join("features.toml"), example).unwrap();
    let (code, json, stderr) = jounce(
        folder.path(),
        &[
            "fit",
            SPEC,
            "--to",
            "features.toml",
            "--json",
            "--out",
            "fit",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    let key = &json["keys"][1];
    assert_eq!(key["key"], "damping.ratios.1");
    let (value_before, value_after) = (
        key["before"].as_f64().unwrap(),
        key["after"].as_f64().unwrap(),
    );
    let share = (value_after / value_before).ln() / (0.002 / value_before).ln();
    assert!((share - 0.25 / 0.26).abs() < 1e-3, "{share} {key}");
    let fitted = std::fs::read_to_string(folder.path().join("fit/fitted.toml")).unwrap();
    let ratios = fitted
        .lines()
        .find(|line| line.starts_with("ratios"))
        .unwrap();
    let first_ratio: f64 = ratios
        .split(['[', ','])
        .nth(1)
        .unwrap()
        .trim()
        .parse()
        .unwrap();
    assert!(
        (first_ratio / value_after - 1.0).abs() < 1e-12 && ratios.matches(',').count() >= 6,
        "{ratios}"
    );
}

/// Every option says what holds without it, and every one that takes something says what.
#[test]
fn options_of_fit_and_modes_state_their_defaults() {
    for command in ["fit", "modes"] {
        let (_, help, _) = outcome(program().args([command, "--help"]));
        let options = help
            .split_once("Options:")
            .unwrap()
            .1
            .split_once("FEATURES,")
            .map_or(help.as_str(), |(options, _)| options);
        let option_texts: Vec<&str> = options.split("\n      --").skip(1).collect();
        assert!(option_texts.len() >= 4, "{help}");
        for option in option_texts {
            let option = option.split("-h, --help").next().unwrap();
            assert!(option.contains("default"), "{command} --{option}");
        }
    }
}
