//! Band of the power over a key, and better designs during a search.

use super::{DRIVE_HZ, FORCE_N, LINEAR, LOAD, linear_at, problem};
use jounce_analysis::{KnownOrbit, Model, Parameter, settled_orbit};
use jounce_control::Control;
use jounce_design::{Improvement, PowerBand, PowerBandSearch, Tolerance, design};
use jounce_orbits::Orbit;
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

/// Orbit on which the paper's harvester with a gap settles from its steady state at a frequency.
fn settled(file: &SpecFile, gap: &str, hz: f64) -> Orbit {
    let mut file = file.clone();
    file.set("stop.tip.gap", gap).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let plant = &base.kernel.plant;
    let start = plant.to_physical(&vec![0.0; plant.len()], 0.0);
    settled_orbit(&Parameter::new(&base, &key, 2.0), hz, &start, 1e-8, 1e-7).unwrap()
}

/// The band of the paper's harvester, against the orbits on which integrations settle
/// at quantiles of the gap, with which the power rises; below about 12.8 Hz the orbit is lost in a Neimark-Sacker bifurcation.
#[test]
fn a_band_of_the_impact_harvester_is_that_of_its_branches() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    let file = SpecFile::read(&path).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let known = settled(&file, "1 mm", 13.0);
    let tolerances = [Tolerance::read(&file, "stop.tip.gap", "0.05 mm").unwrap()];
    let search = PowerBandSearch {
        base: &base,
        key: &key,
        values: vec![12.1, 12.7, 12.85, 13.0, 13.5],
        orbit: KnownOrbit {
            period_cycles: 1,
            state: known.start().to_vec(),
            parameter: 13.0,
        },
        tolerances: &tolerances,
        draws: 128,
        seed: 1,
    };
    let found = search.run().unwrap();
    assert_eq!(found.found_share, [0.0, 0.0, 1.0, 1.0, 1.0]);
    assert!(found.low_w[0].is_nan());
    for (k, hz) in [(2, 12.85), (3, 13.0), (4, 13.5)] {
        let mut powers = ["0.955 mm", "1.045 mm"].map(|gap| settled(&file, gap, hz).mean_power_w);
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
