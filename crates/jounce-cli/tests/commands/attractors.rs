//! Basins and diagrams.

use crate::{PLANT, assert_keys, jounce};
use serde_json::Value;

#[test]
fn basins_print_every_key_and_fractions_of_sum_one() {
    let setting = "drive.shaker.frequency=\"14 Hz\"";
    let (code, json, _) = jounce(&[
        "basins", PLANT, "--starts", "12", "--seed", "3", "--set", setting, "--json",
    ]);
    assert_eq!(code, 0);
    assert_keys(&json, &["attractors", "expected_power_w"]);
    let attractors = json["attractors"].as_array().unwrap();
    attractors.iter().for_each(|a| {
        assert_keys(
            a,
            &[
                "id",
                "period_cycles",
                "chaotic",
                "mean_power_w",
                "fraction",
                "fraction_low",
                "fraction_high",
            ],
        )
    });
    let sum: f64 = attractors
        .iter()
        .map(|a| a["fraction"].as_f64().unwrap())
        .sum();
    assert!((sum - 1.0).abs() < 1e-12, "{json}");
}

/// Ends of Wilson's interval solve its equation, for 6 starts.
fn check_wilson_intervals(attractors: &[Value]) {
    for attractor in attractors
        .iter()
        .flat_map(|attractor| attractor["seen"].as_array().unwrap())
    {
        let [share, low, high] = ["fraction", "fraction_low", "fraction_high"]
            .map(|key| attractor[key].as_f64().unwrap());
        for bound in [low, high] {
            let residual =
                (share - bound).powi(2) - 1.959_964_f64.powi(2) * bound * (1.0 - bound) / 6.0;
            assert!(
                residual.abs() < 1e-6 && low <= share && share <= high,
                "{attractor}"
            );
        }
    }
}

#[test]
fn a_diagram_has_its_points_and_its_attractors() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "diagram",
        PLANT,
        "--over",
        "drive.shaker.frequency=13.4Hz:13.6Hz:0.1Hz",
        "--json",
        "--no-branches",
    ];
    let starts = [
        &arguments[..],
        &[
            "--direction",
            "starts",
            "--starts",
            "6",
            "--out",
            folder.path().to_str().unwrap(),
        ],
    ]
    .concat();
    let (code, json, _) = jounce(&starts);
    assert_eq!((code, json["points"].as_array().unwrap().len()), (0, 18));
    for key in [
        "parameter",
        "direction",
        "start",
        "attractor",
        "motion",
        "period_cycles",
        "contacts_per_period",
        "mean_power_w",
        "section",
    ] {
        assert!(!json["points"][0][key].is_null(), "{key} is missing");
    }
    assert!(
        json["attractors"]
            .as_array()
            .unwrap()
            .iter()
            .any(|attractor| attractor["id"] == "1a")
    );
    check_wilson_intervals(json["attractors"].as_array().unwrap());
    for name in [
        "diagram.csv",
        "attractors.csv",
        "diagram.svg",
        "diagram.png",
    ] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    let stepped = jounce(&arguments).1;
    assert_eq!(stepped["points"].as_array().unwrap().len(), 6);
    assert!(stepped["attractors"].is_null());
}

#[test]
fn basins_start_from_a_plane() {
    let folder = tempfile::tempdir().unwrap();
    let grid = [
        "--grid",
        "displacement=-5mm:5mm:4x",
        "--grid",
        "velocity=-0.5m/s:0.5m/s:3x",
        "--out",
        folder.path().to_str().unwrap(),
    ];
    let (code, json, _) = jounce(
        &[
            &[
                "basins",
                PLANT,
                "--json",
                "--set",
                "drive.shaker.frequency=14 Hz",
            ][..],
            &grid,
        ]
        .concat(),
    );
    assert_eq!((code, json["starts"].as_u64()), (0, Some(12)));
    assert!(folder.path().join("starts.csv").exists() && folder.path().join("basins.png").exists());
    // Contact begins where the displacement towards the stop is its gap.
    assert_eq!(json["gap_m"].as_f64(), Some(1e-3));
    let svg = std::fs::read_to_string(folder.path().join("basins.svg")).unwrap();
    assert!(svg.contains(">gap</text>"), "{svg}");
    for (invalid_grid, message) in [
        ("speed=1:2:3x", "unknown"),
        ("velocity=1m:2m:3x", "is a length"),
        ("displacement=1mm:2mm:1x", "2x or more"),
    ] {
        let (code, json, _) = jounce(&["basins", PLANT, "--json", "--grid", invalid_grid]);
        assert!(
            code == 2 && json["error"].as_str().unwrap().contains(message),
            "{json}"
        );
    }
}
