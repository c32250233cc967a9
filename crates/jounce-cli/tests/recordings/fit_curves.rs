//! Powers, responses and other curves in `jounce fit`.

use super::{assert_keys, jounce};
use std::path::Path;

/// A harvester without a stop: quick to compute.
const HARVESTER: &str = include_str!("../../../jounce-experiment/tests/fitted/harvester.toml");
const RUN: &str = r#"
[drive.shaker]
kind = "base-acceleration"
amplitude = "2 m/s^2"
frequency = "60 Hz"

[run]
start = "linear"
duration = "0.1 s"
average_over = "0.1 s"
"#;

/// Powers and a response of the harvester with a capacitance of 50 nF, as a file of features.
fn features_of_another_capacitance(folder: &Path) -> String {
    let true_values = ["--set", "patch.mfc.capacitance=50nF", "--json"];
    let power = |load: &str| {
        let set = format!("circuit.load.resistance={load}");
        let (code, json, stderr) = jounce(
            folder,
            &[&["run", "small.toml", "--set", &set], &true_values[..]].concat(),
        );
        assert_eq!(code, 0, "{stderr}");
        json["mean_power_w"].as_f64().unwrap()
    };
    let powers = ["10 kohm", "200 kohm"].map(power);
    let response = [
        "frf",
        "small.toml",
        "--base",
        "--low",
        "50Hz",
        "--high",
        "70Hz",
        "--points",
        "3",
    ];
    let (code, json, stderr) = jounce(folder, &[&response[..], &true_values[..]].concat());
    assert_eq!(code, 0, "{stderr}");
    let list = |part: &str| json["responses"]["mfc.voltage"][part].to_string();
    let at: Vec<String> = json["frequency_hz"]
        .as_array()
        .unwrap()
        .iter()
        .map(|hz| format!("\"{hz} Hz\""))
        .collect();
    format!(
        "[free]\n\"patch.mfc.capacitance\" = 0.3\n[[power]]\nover = \"circuit.load.resistance\"\nvalues = [\"10 kohm\", \"200 kohm\"]\n\
         mean_power_w = {powers:?}\ndeviation = 1e-4\n[[response]]\ninput = \"base\"\noutput = \"mfc.voltage\"\nfrequency = [{}]\nre = {}\n\
         im = {}\ndeviation = 1e-4\n",
        at.join(", "),
        list("re"),
        list("im")
    )
}

/// Powers and a response of the harvester itself, of another capacitance, as a user writes them down: it comes back, and tables and pictures of
/// curves are written. Measured: 4.4e-9, relative.
#[test]
fn powers_and_responses_are_fitted_from_a_readable_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path();
    std::fs::write(folder_path.join("small.toml"), [HARVESTER, RUN].concat()).unwrap();
    let features = features_of_another_capacitance(folder_path);
    std::fs::write(folder_path.join("features.toml"), features).unwrap();
    let (code, json, stderr) = jounce(
        folder_path,
        &[
            "fit",
            "small.toml",
            "--to",
            "features.toml",
            "--json",
            "--out",
            "fit",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    let relative_error = json["keys"][0]["after"].as_f64().unwrap() / 50e-9 - 1.0;
    eprintln!("{relative_error:.1e} off");
    assert!(relative_error.abs() < 1e-7, "{json}");
    assert_keys(
        &json["curves"][0],
        &[
            "name", "unit", "over", "at", "measured", "before", "after", "low", "high",
        ],
    );
    for name in [
        "fit-curve-1.csv",
        "fit-curve-2.parquet",
        "fit-features.csv",
        "fit.svg",
        "fitted.toml",
    ] {
        assert!(folder_path.join("fit").join(name).is_file(), "{name}");
    }
}

/// Wrong features and a part of their error.
const WRONG: [(&str, &str); 5] = [
    (
        "[[power]]\nover = \"circuit.load.resistence\"\nvalues = [\"1 kohm\"]\nmean_power_w = [1]\ndeviation = 1\n",
        "resistance",
    ),
    (
        "[[power]]\nover = \"circuit.load.resistance\"\nvalues = [\"1 kg\"]\nmean_power_w = [1]\ndeviation = 1\n",
        "power 1",
    ),
    (
        "[[jump]]\nover = \"drive.shaker.frequency\"\nat = \"9 Hz\"\nbetween = [\"10 Hz\", \"20 Hz\"]\ndeviation = 1\n",
        "between",
    ),
    (
        "[[history]]\nfile = \"none.csv\"\nchannel = \"a\"\noutput = \"mfc.voltage\"\ndeviation = 1\n",
        "none.csv",
    ),
    (
        "[[response]]\ninput = \"base\"\noutput = \"pzt.voltage\"\nfrequency = [\"9 Hz\"]\nmagnitude = [1]\ndeviation = 1\n",
        "mfc",
    ),
];

#[test]
fn wrong_features_of_curves_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path();
    std::fs::write(folder_path.join("small.toml"), [HARVESTER, RUN].concat()).unwrap();
    for (text, message) in WRONG {
        std::fs::write(
            folder_path.join("wrong.toml"),
            format!("[free]\n\"patch.mfc.capacitance\" = 0.3\n{text}"),
        )
        .unwrap();
        let (code, _, stderr) = jounce(folder_path, &["fit", "small.toml", "--to", "wrong.toml"]);
        assert!(
            code == 4 && stderr.contains(message) && !stderr.contains("panicked"),
            "{code}: {stderr}"
        );
    }
}
