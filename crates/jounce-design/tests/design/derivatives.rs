//! Derivatives of the mean power of orbits by keys of the spec, against differences of orbits.

use jounce_analysis::{
    BranchKind, BranchSearch, DerivativeAccuracy, DerivativeKey, KeyLine, Model, OrbitMethodKind,
    Parameter, fold_derivatives, orbit_derivatives,
};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_orbits::{Orbit, OrbitMethod, OrbitQuantity, Shooting};
use jounce_spec::{NumericKey, SpecFile};
use rayon::prelude::*;
use std::io::Write;
use std::path::Path;

const KEYS: [&str; 20] = [
    "stop.tip.gap",
    "stop.tip.stiffness",
    "circuit.load.resistance",
    "drive.shaker.amplitude",
    "beam.beam.length",
    "beam.beam.thickness",
    "beam.beam.youngs_modulus",
    "beam.beam.density",
    "beam.beam.width",
    "beam.beam.point.tip",
    "patch.mfc.start",
    "patch.mfc.length",
    "patch.mfc.width",
    "patch.mfc.thickness",
    "patch.mfc.youngs_modulus",
    "patch.mfc.d31",
    "patch.mfc.capacitance",
    "mass.table.mass",
    "damping.ratios.1",
    "damping.ratios.2",
];

/// An orbit of a model.
struct Case {
    model: Model,
    orbit: Orbit,
    frequency_hz: f64,
}

/// Returns orbits of the paper's harvester on its branches, evenly among those farther than 1 mHz from
/// a grazing.
fn cases(range: (f64, f64), count: usize) -> Vec<Case> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    let file = SpecFile::read(&path).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = NumericKey::find(&base.spec, "drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-9,
        seeds: 2,
        longest_period: 2,
    };
    let branches = search.run().unwrap();
    let grazings: Vec<f64> = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|one| one.kind == BranchKind::Grazing)
        .map(|one| one.at.parameter)
        .collect();
    let is_smooth = |hz: f64| grazings.iter().all(|grazing| (grazing - hz).abs() > 1e-3);
    let all: Vec<(f64, &Orbit)> = branches
        .iter()
        .flat_map(|branch| &branch.points)
        .filter(|point| is_smooth(point.parameter))
        .map(|point| (point.parameter, &point.orbit))
        .collect();
    let chosen = (0..count).map(|k| all[k * (all.len() - 1) / (count - 1)]);
    chosen
        .map(|(frequency_hz, orbit)| {
            let mut spec = base.spec.clone();
            key.set(&mut spec, frequency_hz).unwrap();
            Case {
                model: base.changed(spec).unwrap(),
                orbit: orbit.clone(),
                frequency_hz,
            }
        })
        .collect()
}

/// Returns the mean power, W, of the orbit that continues another one; the state near it, physical.
fn power_w(model: &Model, cycles: u32, physical: &[f64]) -> Option<(f64, Vec<f64>)> {
    let line = KeyLine::at(model);
    let shooting = Shooting::new(&line, &model.kernel, cycles, 1e-13).charged_as(physical);
    let position = Position {
        unknown: shooting.unknown(physical),
        parameter: 0.0,
    };
    let corrector = Corrector {
        goal: 1e-12,
        most: 12,
    };
    let metric = Metric::at(&position, 1.0);
    let found = correct_at(&shooting, &corrector, &metric, position).ok()?;
    let orbit = shooting.orbit(&found.local, found.error).ok()?;
    Some((orbit.mean_power_w, shooting.physical(orbit.start())))
}

/// Returns `d ln P / d ln key` by differences of orbits at three steps, extrapolated, and the change
/// by the last extrapolation; `None` where an orbit is lost or the spec ends.
fn difference(case: &Case, path: &str) -> Option<(f64, f64)> {
    let key = NumericKey::find(&case.model.spec, path).ok()?;
    let value = key.get(&case.model.spec).ok()?;
    let cycles = case.orbit.period_cycles;
    let line = KeyLine::at(&case.model);
    let shooting = Shooting::new(&line, &case.model.kernel, cycles, 1e-13);
    let (here_w, physical) = power_w(&case.model, cycles, &shooting.physical(case.orbit.start()))?;
    let at = |step: f64| {
        let mut spec = case.model.spec.clone();
        key.set(&mut spec, value * (1.0 + step)).ok()?;
        let model = case.model.changed(spec).ok()?;
        Some(power_w(&model, cycles, &physical)?.0)
    };
    let slope = |step: f64| Some((at(step)? - at(-step)?) / (2.0 * step * here_w));
    let (double, whole, half) = (slope(4e-4)?, slope(2e-4)?, slope(1e-4)?);
    let [coarse, fine] = [(whole, double), (half, whole)].map(|(h, w)| h + (h - w) / 3.0);
    Some((fine + (fine - coarse) / 15.0, (fine - coarse).abs()))
}

/// Compares the derivatives at some orbits; returns the number of compared ones and the largest
/// deviation, relative to the derivative or 1.
fn compared(cases: &[Case], paths: &[&str]) -> (usize, f64) {
    let of_case = |case: &Case| -> Vec<(String, f64)> {
        let keys: Vec<NumericKey> = paths
            .iter()
            .map(|path| NumericKey::find(&case.model.spec, path).unwrap())
            .collect();
        let wanted: Vec<DerivativeKey<'_>> = keys
            .iter()
            .map(|key| DerivativeKey {
                key,
                scale: key.get(&case.model.spec).unwrap().abs(),
            })
            .collect();
        let found = orbit_derivatives(
            &case.model,
            &case.orbit,
            &wanted,
            &[OrbitQuantity::MeanPower],
            DerivativeAccuracy::Estimated,
        )
        .unwrap();
        let rows = paths.iter().zip(&wanted).zip(found.by_key);
        rows.filter_map(|((path, key), row)| {
            let value = key.key.get(&case.model.spec).unwrap();
            let relative = row.unwrap()[0].value * value / found.values[0];
            let (expected, error) = difference(case, path)?;
            let size = expected.abs().max(1.0);
            let deviation = (relative - expected).abs() / size;
            let line = format!(
                "{path} at {:.4} Hz, period {}, stable {}: {relative:.9e}, expected {expected:.9e} within {error:.1e}",
                case.frequency_hz,
                case.orbit.period_cycles,
                case.orbit.is_stable(),
            );
            // A difference that is itself no better says nothing.
            (error / size < 3e-8).then_some((line, deviation))
        })
        .collect()
    };
    let all: Vec<(String, f64)> = cases.par_iter().flat_map_iter(of_case).collect();
    for (line, deviation) in all.iter().filter(|(_, deviation)| *deviation > 1e-7) {
        let _ = writeln!(std::io::stderr(), "{deviation:.1e}: {line}");
    }
    let worst = all.iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    let _ = writeln!(
        std::io::stderr(),
        "{} derivatives at {} orbits; the largest deviation is {:.1e}: {}",
        all.len(),
        cases.len(),
        worst.1,
        worst.0
    );
    (all.len(), worst.1)
}

#[test]
fn derivatives_are_those_of_followed_orbits() {
    let cases = cases((11.5, 12.5), 3);
    // The patch is as wide as its beam: its derivative is one-sided, and there is no difference.
    let (count, worst) = compared(
        &cases,
        &[
            "stop.tip.gap",
            "circuit.load.resistance",
            "patch.mfc.d31",
            "patch.mfc.width",
        ],
    );
    assert!(count >= 6 && worst < 1e-7, "{count} {worst}");
}

/// Returns the folds of the paper's harvester between 11.5 and 13.5 Hz, lowest first, and the model.
fn folds(changed: Option<(&str, f64)>) -> (Model, Vec<(f64, Orbit)>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    let mut spec = SpecFile::read(&path).unwrap().spec().unwrap();
    if let Some((path, factor)) = changed {
        let key = NumericKey::find(&spec, path).unwrap();
        let value = key.get(&spec).unwrap();
        key.set(&mut spec, factor * value).unwrap();
    }
    let base = Model::new(spec).unwrap();
    let key = NumericKey::find(&base.spec, FREQUENCY).unwrap();
    let range = (11.5, 13.5);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-11,
        seeds: 2,
        longest_period: 1,
    };
    let branches = search.run().unwrap();
    let found = branches.iter().flat_map(|branch| &branch.bifurcations);
    let mut folds: Vec<(f64, Orbit)> = found
        .filter(|one| one.kind == BranchKind::Fold)
        .map(|one| (one.at.parameter, one.at.orbit.clone()))
        .collect();
    folds.sort_by(|a, b| a.0.total_cmp(&b.0));
    (base, folds)
}

const FREQUENCY: &str = "drive.shaker.frequency";

#[test]
#[ignore = "long: runs with ./test --long"]
fn derivatives_of_folds_are_those_of_followed_folds() {
    let (base, all) = folds(None);
    let paths = ["stop.tip.gap", "stop.tip.stiffness", "beam.beam.length"];
    assert!(!all.is_empty());
    for (index, (frequency_hz, orbit)) in all.iter().enumerate() {
        let mut spec = base.spec.clone();
        let frequency = NumericKey::find(&spec, FREQUENCY).unwrap();
        frequency.set(&mut spec, *frequency_hz).unwrap();
        let model = base.changed(spec).unwrap();
        let keys = paths.map(|path| NumericKey::find(&base.spec, path).unwrap());
        let value = |key: &NumericKey| key.get(&base.spec).unwrap();
        let wanted = keys.each_ref().map(|key| DerivativeKey {
            key,
            scale: value(key),
        });
        let over = DerivativeKey {
            key: &frequency,
            scale: *frequency_hz,
        };
        let found = fold_derivatives(&model, orbit, over, &wanted).unwrap();
        for ((path, key), found) in paths.iter().zip(&keys).zip(found) {
            let at = |factor: f64| folds(Some((path, factor))).1[index].0;
            let slope = |h: f64| (at(1.0 + h) - at(1.0 - h)) / (2.0 * h);
            let expected = (4.0 * slope(1e-4) - slope(2e-4)) / 3.0;
            let relative = found.value * value(key);
            let deviation = (relative - expected).abs() / expected.abs();
            eprintln!("fold at {frequency_hz}: {path}: {relative:e}, expected {expected:e}");
            assert!(
                deviation < 1e-5,
                "{path} at {frequency_hz}: {relative:e} {expected:e}"
            );
        }
    }
}

#[test]
#[ignore = "long: 60 orbits, each followed to changed values of 20 keys"]
fn derivatives_by_20_keys_at_60_orbits() {
    let cases = cases((11.0, 14.0), 60);
    assert!(cases.iter().any(|case| !case.orbit.is_stable()));
    let (count, worst) = compared(&cases, &KEYS);
    assert!(count > 800 && worst < 1e-7, "{count} {worst}");
}
