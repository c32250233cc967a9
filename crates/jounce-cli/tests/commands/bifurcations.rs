//! Curves of bifurcations and peaks.

use crate::warnings::write_spec;
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

/// A dashpot makes the multipliers too rough for the curve: the fold that `branch` finds at 73.3169 Hz
/// is listed all the same, with the reason.
#[test]
fn a_fold_that_cannot_be_followed_is_listed() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_spec(
        &folder,
        "[beam.arm]\nmaterial = \"steel\"\nlength = \"120 mm\"\nwidth = \"15 mm\"\nthickness = \"0.8 mm\"\n\
        [beam.arm.point]\ntip = \"112 mm\"\n\
        [patch.pzt]\non = \"arm\"\nmaterial = \"PZT-5H\"\nstart = \"3 mm\"\nlength = \"30 mm\"\nwidth = \"15 mm\"\nthickness = \"0.25 mm\"\n\
        [stop.bump]\nat = \"arm.tip\"\ngap = \"0.4 mm\"\nlaw = \"kelvin-voigt\"\nstiffness = \"20 kN/m\"\ndamping = \"2 N s/m\"\n\
        [circuit.r]\npatch = \"pzt\"\nresistance = \"30 kohm\"\n\
        [drive.base]\nkind = \"base-acceleration\"\namplitude = \"2 g\"\nfrequency = \"60 Hz\"\n\
        [damping]\nbeyond = 0.012\n[reduction]\nmodes = 6\n",
    );
    let over = ["--over", "drive.base.frequency=72Hz:74Hz"];
    let against = ["--against", "stop.bump.gap=0.38mm:0.42mm"];
    let few = ["--no-peaks", "--longest-period", "1", "--seeds", "0"];
    let (_, json, text) = jounce(
        &[
            &["bifurcations", &spec, "--json"][..],
            &over,
            &against,
            &few,
        ]
        .concat(),
    );
    let curves = json["curves"].as_array().unwrap();
    let has_fold = curves.iter().any(|curve| {
        let mut points = curve["points"].as_array().unwrap().iter();
        let at = |point: &Value, name: &str| point[name].as_f64().unwrap();
        curve["kind"] == "fold"
            && points.any(|point| {
                (at(point, "parameter") - 73.316918).abs() < 1e-5
                    && (at(point, "parameter_2") - 4e-4).abs() < 1e-9
            })
    });
    assert!(has_fold, "{json} {text}");
}
