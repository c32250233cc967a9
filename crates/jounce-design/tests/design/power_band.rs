//! Band of the power over a key, and better designs during a search.

use super::{DRIVE_HZ, FORCE_N, LINEAR, LOAD, linear_at, problem};
use jounce_analysis::{Branch, BranchSearch, KnownOrbit, Model, OrbitMethodKind, Parameter};
use jounce_control::Control;
use jounce_design::{Improvement, PowerBand, PowerBandSearch, Tolerance, design};
use jounce_spec::SpecFile;
use std::path::Path;
use std::sync::Mutex;

/// Bands of the linear harvester over a key; Newton's method finds its orbit from rest.
fn band(key: &str, values: &[f64], tolerance: (&str, &str)) -> PowerBand {
    let file = SpecFile::from_text(LINEAR);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(key).unwrap();
    let tolerances = [Tolerance::read(&file, tolerance.0, tolerance.1).unwrap()];
    let search = PowerBandSearch {
        base: &base,
        key: &key,
        values: values.to_vec(),
        orbit: KnownOrbit {
            period_cycles: 1,
            state: vec![0.0; base.kernel.plant.len()],
            parameter: key.get(&base.spec).unwrap(),
        },
        tolerances: &tolerances,
        draws: 256,
        seed: 1,
    };
    search.run().unwrap()
}

/// The power is the square of the force, whose quantiles are known, at each frequency.
#[test]
fn a_band_over_the_frequency_is_that_of_the_force() {
    let values = [9.2, 9.5, 9.8, 10.1, 10.4];
    let found = band(
        "drive.d.frequency",
        &values,
        ("drive.d.amplitude", "0.07 N"),
    );
    assert_eq!(found.parameter, values);
    for (k, hz) in values.into_iter().enumerate() {
        let power_w = |share: f64| {
            let force_n = FORCE_N + 0.07 * (2.0 * share - 1.0);
            linear_at(80e3, hz).1 * (force_n / FORCE_N).powi(2)
        };
        let pairs = [
            (found.low_w[k], 0.05),
            (found.median_w[k], 0.5),
            (found.high_w[k], 0.95),
        ];
        for (value, share) in pairs {
            let error = (value / power_w(share) - 1.0).abs();
            assert!(error < 3e-3, "{hz} Hz, {share}: {value}, {error}");
        }
        assert_eq!(found.found_share[k], 1.0);
    }
}

/// A tolerance of the key of the axis scatters about each of its values.
#[test]
fn a_tolerance_of_the_axis_scatters_about_its_values() {
    let values = [20e3, 60e3];
    let found = band(
        "circuit.load.resistance",
        &values,
        ("circuit.load.resistance", "5 kohm"),
    );
    for (k, ohm) in values.into_iter().enumerate() {
        let [low, high] = [-4.5e3, 4.5e3].map(|deviation| linear_at(ohm + deviation, DRIVE_HZ).1);
        for (value, expected) in [(found.low_w[k], low), (found.high_w[k], high)] {
            assert!((value / expected - 1.0).abs() < 3e-3, "{value} {expected}");
        }
    }
}

/// Branches of the paper's harvester over the frequency with another gap.
fn branches(file: &SpecFile, gap: &str, range: (f64, f64)) -> Vec<Branch> {
    let mut file = file.clone();
    file.set("stop.tip.gap", gap).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let search = BranchSearch {
        base: &base,
        parameter: &Parameter::new(&base, &key, range.1 - range.0),
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-8,
        seeds: 0,
        longest_period: 1,
    };
    search.run().unwrap()
}

/// Largest power of a stable point of branches next to a frequency, W.
fn power_at(branches: &[Branch], hz: f64) -> f64 {
    let pairs = branches.iter().flat_map(|branch| branch.points.windows(2));
    let power = |pair: &[jounce_analysis::BranchPoint]| {
        let share = (hz - pair[0].parameter) / (pair[1].parameter - pair[0].parameter);
        let [a, b] = [&pair[0].orbit, &pair[1].orbit];
        let is_there = (0.0..=1.0).contains(&share) && a.is_stable() && b.is_stable();
        is_there.then(|| a.mean_power_w + share * (b.mean_power_w - a.mean_power_w))
    };
    pairs.filter_map(power).fold(0.0, f64::max)
}

/// The band of the paper's harvester, whose power rises with the gap, against branches at the
/// quantiles of the gap; below their folds the orbit is lost.
#[test]
fn a_band_of_the_impact_harvester_is_that_of_its_branches() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    let file = SpecFile::read(&path).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let range = (12.0, 14.0);
    let nominal = branches(&file, "1 mm", range);
    let points = nominal.iter().flat_map(|branch| &branch.points);
    let near = |point: &&jounce_analysis::BranchPoint| (point.parameter - 13.0).abs();
    let known = points
        .filter(|point| point.orbit.is_stable())
        .min_by(|a, b| near(a).total_cmp(&near(b)))
        .unwrap();
    let tolerances = [Tolerance::read(&file, "stop.tip.gap", "0.05 mm").unwrap()];
    let search = PowerBandSearch {
        base: &base,
        key: &key,
        values: vec![12.1, 12.8, 13.0, 13.5],
        orbit: KnownOrbit {
            period_cycles: 1,
            state: known.orbit.start().to_vec(),
            parameter: known.parameter,
        },
        tolerances: &tolerances,
        draws: 128,
        seed: 1,
    };
    let found = search.run().unwrap();
    let ends = ["0.955 mm", "1.045 mm"].map(|gap| branches(&file, gap, range));
    assert_eq!(found.found_share, [0.0, 1.0, 1.0, 1.0]);
    assert!(found.low_w[0].is_nan());
    for (k, hz) in [(1, 12.8), (2, 13.0), (3, 13.5)] {
        let mut powers = [0, 1].map(|side| power_at(&ends[side], hz));
        powers.sort_by(f64::total_cmp);
        for (value, expected) in [found.low_w[k], found.high_w[k]].into_iter().zip(powers) {
            let error = (value / expected - 1.0).abs();
            assert!(error < 5e-3, "{hz} Hz: {value} {expected}");
        }
    }
}

/// Each better design is reported, and the result does not depend on it.
#[test]
fn better_designs_are_reported_and_change_nothing() {
    let text = format!("evaluations = 120\n{LOAD}[limits]\n\"patch.m.p.voltage\" = \"20 V\"\n");
    let problem = problem(&text).unwrap();
    let reports: Mutex<Vec<Improvement>> = Mutex::default();
    let report = |one: &Improvement| reports.lock().unwrap().push(one.clone());
    let mut found = design(&problem, &Control::default(), None, Some(&report)).unwrap();
    let mut expected = design(&problem, &Control::default(), None, None).unwrap();
    (found.wall_time_s, expected.wall_time_s) = (0.0, 0.0);
    assert_eq!(found, expected);
    let reports = reports.into_inner().unwrap();
    let points: Vec<_> = reports.iter().map(|one| one.point).collect();
    assert_eq!(points, found.trace);
    let last = reports.last().unwrap();
    assert_eq!(last.set, found.best.set);
    assert_eq!(last.limits[0].value, found.limits[0].value);
}
