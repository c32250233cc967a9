//! `jounce fit` from the outside.

use super::{has, jounce};

const SPEC: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/impact-harvester-2019/harvester.toml");
const MEASURED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/impact-harvester-2019/measured.toml");

/// The paper's own model is up to 6.1 % off, the laminate before the fit 0.86 %. Measured with four keys fitted: at most 0.464 % (the seventh).
/// That is more than the digits of the paper allow, and the answer must say so.
#[test]
fn fit_brings_every_measured_frequency_of_the_paper_within_half_a_percent() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["fit", SPEC, "--to", MEASURED, "--set", "patch.mfc.section=laminate", "--json", "--out", "fit"];
    let (code, json, stderr) = jounce(folder.path(), &arguments);
    assert_eq!(code, 0, "{stderr}");
    has(&json, &["keys", "features", "correlation", "chi_square", "objective", "warnings", "evaluations"]);
    has(&json["keys"][0], &["key", "unit", "before", "after", "low", "high", "prior_deviation", "deviation"]);
    let features = json["features"].as_array().unwrap();
    has(&features[0], &["name", "unit", "measured", "deviation", "before", "after", "predicted_deviation"]);
    assert_eq!(features.len(), 7);
    for feature in features {
        let error = feature["after"].as_f64().unwrap() / feature["measured"].as_f64().unwrap() - 1.0;
        assert!(error.abs() < 5e-3, "{feature}");
    }
    assert!(json["warnings"].to_string().contains("chi square"), "{}", json["warnings"]);
    let (code, modes, _) =
        jounce(folder.path(), &["modes", "fit/fitted.toml", "--set", "patch.mfc.section=laminate", "--fixed-table", "--json"]);
    let fitted = |k: usize| modes["modes"][k]["frequency_hz"].as_f64().unwrap() / features[k]["after"].as_f64().unwrap() - 1.0;
    assert!(code == 0 && (0..7).all(|k| fitted(k).abs() < 1e-9), "{modes}");
    let there = ["fit-keys.csv", "fit-keys.parquet", "fit-features.json", "fit.svg", "fit.png"];
    there.iter().for_each(|name| assert!(folder.path().join("fit").join(name).is_file(), "{name}"));
}

#[test]
fn a_fit_that_cannot_be_done_says_why() {
    let folder = tempfile::tempdir().unwrap();
    for (text, words) in [
        ("[free]\n\"beam.beam.lenght\" = 0.1\n", "beam.beam.length"),
        ("[free]\n\"beam.beam.length\" = \"1 %\"\n", "number above 0"),
        ("hold = [\"tabel\"]\n[free]\n\"beam.beam.length\" = 0.1\n", "tabel"),
    ] {
        let mode = "[[mode]]\nnumber = 1\nfrequency = \"9 Hz\"\nfrequency_deviation = 0.01\n";
        std::fs::write(folder.path().join("features.toml"), format!("{text}{mode}")).unwrap();
        let (code, _, stderr) = jounce(folder.path(), &["fit", SPEC, "--to", "features.toml"]);
        assert!(code == 4 && stderr.contains(words) && !stderr.contains("panicked"), "{code}: {stderr}");
    }
    let (code, _, stderr) = jounce(folder.path(), &["fit", SPEC, "--to", "missing.toml"]);
    assert!(code == 4 && stderr.contains("missing.toml"), "{stderr}");
}
