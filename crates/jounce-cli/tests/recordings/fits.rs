//! `jounce fit` from the outside.

use super::{assert_keys, jounce};
use serde_json::Value;
use std::path::Path;

pub const SPEC: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/harvester.toml"
);
const MEASURED: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/measured.toml"
);

/// Keys of `fit`.
const FIT_KEYS: [&str; 10] = [
    "keys",
    "features",
    "curves",
    "deviations",
    "quantile",
    "correlation",
    "chi_square",
    "objective",
    "warnings",
    "evaluations",
];

/// Keys of a fitted key.
const KEY_KEYS: [&str; 8] = [
    "key",
    "unit",
    "before",
    "after",
    "low",
    "high",
    "prior_deviation",
    "deviation",
];

/// Keys of a feature.
const FEATURE_KEYS: [&str; 9] = [
    "name",
    "unit",
    "measured",
    "deviation",
    "before",
    "after",
    "predicted_deviation",
    "low",
    "high",
];

/// The modes of the written spec are those that the fit lists.
fn check_modes_of_the_fitted_spec(folder: &Path, features: &[Value]) {
    let (code, modes, _) = jounce(
        folder,
        &[
            "modes",
            "fit/fitted.toml",
            "--set",
            "patch.mfc.section=laminate",
            "--fixed-table",
            "--json",
        ],
    );
    let fitted = |k: usize| {
        modes["modes"][k]["frequency_hz"].as_f64().unwrap() / features[k]["after"].as_f64().unwrap()
            - 1.0
    };
    assert!(
        code == 0 && (0..7).all(|k| fitted(k).abs() < 1e-9),
        "{modes}"
    );
}

/// The paper's own model is up to 6.1 % off, the laminate before the fit 0.86 %. Measured with five keys fitted: at most 0.427 % (the seventh),
/// with a deviation of 0.27 % that comes from the residuals. No key goes further than 1.1 deviations of what was known of it.
#[test]
fn fit_brings_every_measured_frequency_of_the_paper_within_half_a_percent() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "fit",
        SPEC,
        "--to",
        MEASURED,
        "--set",
        "patch.mfc.section=laminate",
        "--json",
        "--out",
        "fit",
    ];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    assert_keys(&json, &FIT_KEYS);
    assert_keys(&json["keys"][0], &KEY_KEYS);
    let features = json["features"].as_array().unwrap();
    assert_keys(&features[0], &FEATURE_KEYS);
    assert_eq!(features.len(), 7);
    for feature in features {
        let error =
            feature["after"].as_f64().unwrap() / feature["measured"].as_f64().unwrap() - 1.0;
        assert!(error.abs() < 5e-3, "{feature}");
    }
    assert_keys(
        &json["deviations"][0],
        &["name", "deviation", "degrees_of_freedom"],
    );
    let deviation = json["deviations"][0]["deviation"].as_f64().unwrap();
    assert!((deviation - 2.66e-3).abs() < 2e-4, "{deviation}");
    for key in json["keys"].as_array().unwrap() {
        let number = |name: &str| key[name].as_f64().unwrap();
        assert!(
            (number("after") / number("before")).ln().abs() < 2.0 * number("prior_deviation"),
            "{key}"
        );
    }
    check_modes_of_the_fitted_spec(folder.path(), features);
    let file_names = [
        "fit-keys.csv",
        "fit-keys.parquet",
        "fit-features.json",
        "fit.svg",
        "fit.png",
    ];
    file_names
        .iter()
        .for_each(|name| assert!(folder.path().join("fit").join(name).is_file(), "{name}"));
}

#[test]
fn an_impossible_fit_gives_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    for (text, message) in [
        ("[free]\n\"beam.beam.lenght\" = 0.1\n", "beam.beam.length"),
        ("[free]\n\"beam.beam.length\" = \"1 %\"\n", "number above 0"),
        (
            "frequency_deviation = \"good\"\n[free]\n\"beam.beam.length\" = 0.1\n",
            "residuals",
        ),
        (
            "hold = [\"tabel\"]\n[free]\n\"beam.beam.length\" = 0.1\n",
            "tabel",
        ),
    ] {
        let mode = "[[mode]]\nnumber = 1\nfrequency = \"9 Hz\"\nfrequency_deviation = 0.01\n";
        std::fs::write(folder.path().join("features.toml"), format!("{text}{mode}")).unwrap();
        let (code, _, stderr) = jounce(folder.path(), &["fit", SPEC, "--to", "features.toml"]);
        assert!(
            code == 4 && stderr.contains(message) && !stderr.contains("panicked"),
            "{code}: {stderr}"
        );
    }
    let (code, _, stderr) = jounce(folder.path(), &["fit", SPEC, "--to", "missing.toml"]);
    assert!(code == 4 && stderr.contains("missing.toml"), "{stderr}");
}

/// Modes of a harvester whose base moves, measured with the base held: every frequency meets the number of another mode, and the first of them is
/// the second of the model.
#[test]
fn a_fit_to_the_modes_of_another_support_gives_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let text = include_str!("../../../../examples/impact-harvester-2019/measured.toml")
        .replace("hold = [\"table\"]", "");
    std::fs::write(folder.path().join("features.toml"), text).unwrap();
    let (code, json, stderr) = jounce(
        folder.path(),
        &["fit", SPEC, "--to", "features.toml", "--json"],
    );
    assert_eq!(code, 0, "{stderr}");
    let warnings = json["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|warning| warning.as_str());
    let warning = warnings
        .into_iter()
        .find(|warning| warning.contains("the model misses frequencies by"))
        .expect("a warning");
    assert!(
        warning.contains("9.01 Hz is nearest to mode 2 of the initial model")
            && warning.contains("`hold`"),
        "{warning}"
    );
}
