//! Curves of bifurcations and peaks.

use crate::{PLANT, assert_keys, jounce};
use serde_json::Value;

#[test]
fn bifurcations_print_every_key() {
    let (over, against) = (
        "drive.shaker.frequency=11Hz:13Hz",
        "stop.tip.gap=0.9mm:1.1mm",
    );
    let (code, json, _) = jounce(&[
        "bifurcations",
        PLANT,
        "--over",
        over,
        "--against",
        against,
        "--seeds",
        "0",
        "--json",
    ]);
    assert_eq!(code, 0);
    let folds = json["curves"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|curve| curve["kind"] == "fold");
    let points: Vec<&Value> = folds
        .flat_map(|fold| fold["points"].as_array().unwrap())
        .collect();
    assert_keys(points[0], &["parameter", "parameter_2", "mean_power_w"]);
    let owner = points
        .iter()
        .filter(|point| (point["parameter_2"].as_f64().unwrap() - 1e-3).abs() < 1e-12);
    assert!(
        owner
            .clone()
            .any(|point| (point["parameter"].as_f64().unwrap() - 12.3218).abs() < 1e-3),
        "{json}"
    );
}

#[test]
fn bifurcations_give_the_curve_of_peaks() {
    let keys = [
        "--over",
        "drive.shaker.frequency=11.9Hz:12.5Hz",
        "--against",
        "drive.shaker.amplitude=48N:50N",
    ];
    let (code, json, _) = jounce(
        &[
            &[
                "bifurcations",
                PLANT,
                "--seeds",
                "0",
                "--longest-period",
                "1",
                "--json",
            ][..],
            &keys,
        ]
        .concat(),
    );
    assert_eq!(code, 0);
    let curves = json["curves"].as_array().unwrap();
    let curve_count = |kind: &str| curves.iter().filter(|curve| curve["kind"] == kind).count();
    assert!(
        curve_count("peak") >= 1 && curve_count("fold") >= 1,
        "{:?}",
        curves
            .iter()
            .map(|curve| &curve["kind"])
            .collect::<Vec<_>>()
    );
    let peak = curves.iter().find(|curve| curve["kind"] == "peak").unwrap();
    let point_at_50 = peak["points"]
        .as_array()
        .unwrap()
        .iter()
        .find(|point| point["parameter_2"] == 50.0)
        .unwrap();
    assert!(
        (point_at_50["parameter"].as_f64().unwrap() - 12.311_867).abs() < 1e-5
            && point_at_50["stable"] == true,
        "{point_at_50}"
    );
}
