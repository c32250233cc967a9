//! Level curves over two keys.

use crate::harvesters::bench;
use jounce_analysis::{
    BifurcationCurve, BifurcationSearch, BranchKind, BranchOptions, BranchSearch, CurveKind, Model,
    OrbitMethodKind, Parameter, QuantityLevel,
};
use jounce_model::linear::steady_power_w;
use jounce_spec::SpecFile;

const KEYS: [&str; 2] = ["drive.shaker.frequency", "drive.shaker.amplitude"];

fn options(base: &Model, level: &str) -> BranchOptions {
    BranchOptions {
        levels: vec![QuantityLevel::parse(level, &base.kernel.plant).unwrap()],
        ..BranchOptions::default()
    }
}

/// Curves of a level over frequency and amplitude.
fn curves(file: &SpecFile, level: &str, ranges: [(f64, f64); 2]) -> Vec<BifurcationCurve> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let keys = KEYS.map(|key| file.numeric_key(key).unwrap());
    let (tolerance, seeds) = (1e-10, 0);
    let search = BifurcationSearch {
        base: &base,
        keys: [&keys[0], &keys[1]],
        ranges,
        tolerance,
        seeds,
        longest_period: 1,
        peaks: false,
    };
    let mut level_curves = search.run_with(&options(&base, level)).unwrap();
    level_curves.retain(|curve| curve.kind == CurveKind::Bifurcation(BranchKind::Level));
    level_curves.iter().for_each(|curve| {
        eprintln!(
            "{level}: {} points, {:?}",
            curve.points.len(),
            curve.failures
        )
    });
    assert!(
        level_curves
            .iter()
            .all(|curve| curve.level.as_deref() == Some(level))
    );
    level_curves
}

/// Without contact the mean power is that of the steady state, in closed form.
#[test]
fn a_level_of_power_without_contact_is_that_of_the_steady_power() {
    let mut file = bench();
    file.set("stop.tip.gap", "\"500 mm\"").unwrap();
    let level_curves = curves(&file, "mean_power=100 uW", [(8.2, 9.4), (1.0, 20.0)]);
    let [curve] = &level_curves[..] else {
        panic!("{} curves", level_curves.len())
    };
    assert!(curve.failures.is_empty() && curve.points.len() > 5);
    let plant = Model::new(file.spec().unwrap()).unwrap().kernel.plant;
    for point in &curve.points {
        let mut drives = plant.system.drives.clone();
        (drives[0].frequency_hz, drives[0].amplitude_n) = (point.parameter, point.parameter_2);
        let power_w = steady_power_w(&plant.with_drives(drives).unwrap());
        assert!(
            (power_w / 100e-6 - 1.0).abs() < 1e-6,
            "{point:?}: {power_w:e}"
        );
    }
}

/// With contact the curves of a force pass through the labels of branches at the two outer
/// amplitudes.
#[test]
#[ignore = "long: runs with ./test --long"]
fn a_level_of_contact_force_passes_the_labels_along_one_key() {
    let (level, range) = ("contact_force.tip=0.3 N", (11.0, 14.5));
    let level_curves = curves(&bench(), level, [range, (48.0, 52.0)]);
    let mut labels = 0;
    for amplitude_n in [48.0, 52.0] {
        let mut file = bench();
        file.set(KEYS[1], &format!("\"{amplitude_n} N\"")).unwrap();
        let base = Model::new(file.spec().unwrap()).unwrap();
        let key = file.numeric_key(KEYS[0]).unwrap();
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let (method, tolerance) = (OrbitMethodKind::Shooting, 1e-10);
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method,
            tolerance,
            seeds: 0,
            longest_period: 1,
        };
        let along = search.run_with(&options(&base, level)).unwrap();
        for label in along
            .iter()
            .flat_map(|branch| &branch.bifurcations)
            .filter(|label| label.kind == BranchKind::Level)
        {
            let points = level_curves
                .iter()
                .flat_map(|curve| &curve.points)
                .filter(|point| point.parameter_2 == amplitude_n);
            let distance_hz = points
                .map(|point| (point.parameter - label.at.parameter).abs())
                .fold(f64::INFINITY, f64::min);
            eprintln!(
                "{amplitude_n} N, {:.6} Hz: {distance_hz:.1e} Hz away",
                label.at.parameter
            );
            assert!(distance_hz < 1e-6, "{distance_hz:e}");
            labels += 1;
        }
    }
    assert!(labels >= 2, "{labels}");
}
