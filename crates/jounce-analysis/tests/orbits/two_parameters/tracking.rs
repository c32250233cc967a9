//! Bifurcations in two parameters: closed forms, and the points found along one parameter.

use super::bifurcation_curves;
use crate::harvesters::{Systems, bench, branches};
use jounce_analysis::{BifurcationCurve, BranchKind, CurveKind, Model, OrbitMethodKind};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_dynamics::Integrator;
use jounce_model::plant::{PlantError, System};
use jounce_model::reference::ImpactOscillator;
use jounce_orbits::{Condition, ExtendedProblem, ParametricModel, Shooting, TwoParameterProblem};
use std::f64::consts::TAU;

const CORRECTOR: Corrector = Corrector {
    goal: 1e-10,
    most: 20,
};

fn oscillator(gap: f64, frequency_ratio: f64) -> ImpactOscillator {
    ImpactOscillator {
        frequency_ratio,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap,
    }
}

/// Gap and frequency ratio as parameters; the drive does not start at the impact.
struct Gaps {
    angle_rad: f64,
}

impl TwoParameterProblem for Gaps {
    type Line = Systems<Box<dyn Fn(f64) -> System + Sync>>;

    fn line(&self, frequency_ratio: f64) -> Result<Self::Line, PlantError> {
        let angle_rad = self.angle_rad;
        Ok(Systems(Box::new(move |gap| {
            oscillator(gap, frequency_ratio).system(angle_rad)
        })))
    }

    fn differences(&self, _at: [f64; 2]) -> [f64; 2] {
        [1e-6, 1e-6]
    }
}

/// Gap of the doubling in closed form: `1 + trace + determinant = 0`.
fn doubling_gap(frequency_ratio: f64) -> f64 {
    let past = |gap: f64| {
        let [trace, determinant] = oscillator(gap, frequency_ratio)
            .orbits(1)
            .pop()
            .unwrap()
            .trace_determinant;
        1.0 + trace + determinant
    };
    let (mut low, mut high) = (0.6, 2.2);
    assert!(past(low) * past(high) < 0.0, "{} {}", past(low), past(high));
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if past(low) * past(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    low
}

#[test]
fn doublings_of_the_impact_oscillator_are_those_of_the_closed_form() {
    let ratio = 0.8;
    let gap = doubling_gap(ratio);
    let reference = oscillator(gap, ratio);
    let exact = reference.orbits(1).pop().unwrap();
    let plane = Gaps {
        angle_rad: exact.angle_rad + TAU / 3.0,
    };
    let line = plane.line(ratio).unwrap();
    let kernel = line.at(gap).unwrap().kernel;
    let shooting = Shooting::new(&line, &kernel, 1, 1e-12);
    let start_s = (exact.angle_rad - plane.angle_rad).rem_euclid(TAU) / ratio;
    let y = kernel
        .plant
        .from_physical(&reference.start(&exact), start_s);
    let mut integrator = Integrator::new(&kernel, &y, start_s, 1e-12).unwrap();
    integrator.advance_to(TAU / ratio).unwrap();
    let start = shooting.unknown(&kernel.plant.to_physical(&integrator.state(), 0.0));
    let tracking = ExtendedProblem {
        plane: &plane,
        condition: Condition::Multiplier(-1.0),
        cycles: 1,
        tolerance: 1e-12,
        scale: shooting.scale.clone(),
        origin: gap,
        unit: 1.0,
    };
    for (ratio, expected) in [(ratio, gap), (0.805, doubling_gap(0.805))] {
        let position = Position {
            unknown: tracking.unknown(&start, 1.01 * gap),
            parameter: ratio,
        };
        let solution =
            correct_at(&tracking, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
        let there = tracking.parameter(&solution.position.unknown);
        eprintln!("w = {ratio}: gap {there:.12}, closed form {expected:.12}");
        assert!((there / expected - 1.0).abs() < 1e-8, "{there} {expected}");
    }
}

/// The low branch grazes where the steady amplitude equals the gap.
fn check_grazings_of_the_low_branch(base: &Model, curves: &[BifurcationCurve]) {
    let grazing = curves
        .iter()
        .find(|curve| curve.kind == CurveKind::Bifurcation(BranchKind::Grazing))
        .unwrap();
    for point in &grazing.points {
        let mut drives = base.kernel.plant.system.drives.clone();
        (drives[0].frequency_hz, drives[0].amplitude_n) = (point.parameter, point.parameter_2);
        let amplitude_m =
            base.kernel.plant.with_drives(drives).unwrap().ports[0].steady_m[0].norm();
        assert!(
            (amplitude_m / 1e-3 - 1.0).abs() < 1e-6,
            "{point:?}: {amplitude_m}"
        );
    }
}

#[test]
fn folds_tori_and_grazings_over_the_amplitude_are_those_along_the_frequency() {
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let curves = bifurcation_curves(
        &file,
        "drive.shaker.amplitude",
        [(11.0, 14.5), (45.0, 55.0)],
        1e-10,
    );
    for curve in &curves {
        eprintln!(
            "{:?}: {} points, {:?}",
            curve.kind,
            curve.points.len(),
            curve.failures
        );
    }
    // Both ends of the range are points of the curves, to full accuracy.
    for amplitude_n in [45.0, 55.0] {
        let mut changed = bench();
        changed
            .set("drive.shaker.amplitude", &format!("\"{amplitude_n} N\""))
            .unwrap();
        let along = branches(&changed, (11.0, 14.5), OrbitMethodKind::Shooting, 0);
        let all = along.iter().flat_map(|branch| &branch.bifurcations);
        for bifurcation in all.filter(|bifurcation| {
            [
                BranchKind::Fold,
                BranchKind::NeimarkSacker,
                BranchKind::Grazing,
            ]
            .contains(&bifurcation.kind)
        }) {
            let same = curves
                .iter()
                .filter(|curve| curve.kind == CurveKind::Bifurcation(bifurcation.kind))
                .flat_map(|curve| &curve.points);
            let distance = (same.filter(|point| point.parameter_2 == amplitude_n))
                .map(|point| (point.parameter - bifurcation.at.parameter).abs())
                .fold(f64::INFINITY, f64::min);
            eprintln!(
                "{:?} at {amplitude_n} N, {:.6} Hz: {distance:.1e} Hz away",
                bifurcation.kind, bifurcation.at.parameter
            );
            assert!(distance < 1e-6, "{:?}: {distance:e}", bifurcation.kind);
        }
    }
    check_grazings_of_the_low_branch(&base, &curves);
}

/// Frequency of the fold of highest power along the branches at a stiffness.
fn fold_along_the_branch(stiffness: f64, range: (f64, f64)) -> f64 {
    let mut changed = bench();
    changed
        .set("stop.tip.stiffness", &format!("\"{stiffness} N/m^1.5\""))
        .unwrap();
    let along = branches(&changed, range, OrbitMethodKind::Shooting, 0);
    let folds = along
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == BranchKind::Fold);
    folds
        .max_by(|a, b| a.at.orbit.mean_power_w.total_cmp(&b.at.orbit.mean_power_w))
        .unwrap()
        .at
        .parameter
}

/// The upper fold of the paper's harvester over the stiffness of its stop, against the folds along
/// the frequency at fixed stiffness.
#[test]
fn the_fold_over_the_stiffness_is_complete_and_the_same_at_each_tolerance() {
    let range = (10.5, 14.0);
    let curve = |tolerance: f64| {
        let ranges = [range, (400.0, 2000.0)];
        let found = bifurcation_curves(&bench(), "stop.tip.stiffness", ranges, tolerance);
        let upper = |curve: &BifurcationCurve| {
            let top_w = curve
                .points
                .iter()
                .map(|point| point.mean_power_w)
                .fold(0.0, f64::max);
            curve.kind == CurveKind::Bifurcation(BranchKind::Fold) && top_w > 1e-3
        };
        let mut upper_curves: Vec<BifurcationCurve> = found.into_iter().filter(upper).collect();
        assert_eq!(upper_curves.len(), 1, "at tolerance {tolerance:e}");
        upper_curves.pop().unwrap()
    };
    let curves = [1e-8, 1e-9, 1e-10].map(|tolerance| (tolerance, curve(tolerance)));
    for (tolerance, curve) in &curves {
        eprintln!(
            "tolerance {tolerance:e}: {} points, {:?}",
            curve.points.len(),
            curve.failures
        );
        assert!(
            curve.failures.is_empty() && (20..150).contains(&curve.points.len()),
            "{tolerance:e}"
        );
    }
    for stiffness in [400.0, 850.0, 1000.0, 2000.0] {
        let fold_hz = fold_along_the_branch(stiffness, range);
        for (tolerance, curve) in &curves {
            let crossings = curve.crossings(stiffness);
            let distance = crossings
                .iter()
                .map(|(hz, _)| (hz - fold_hz).abs())
                .fold(f64::INFINITY, f64::min);
            eprintln!(
                "{stiffness} N/m^1.5, tolerance {tolerance:e}: {:.6} Hz along the branch, {distance:.1e} Hz away",
                fold_hz
            );
            // The ends of the range and the value in the spec are points of the curve; 850 lies
            // between two, on their chord.
            let allowed = if stiffness == 850.0 {
                2e-3
            } else {
                10.0 * tolerance.max(1e-7)
            };
            assert!(distance < allowed, "{distance:e}");
        }
    }
}

/// A curve that leaves the range of the first key ends on its edge, and a start point on an edge of
/// the second is one point.
#[test]
fn curves_are_cut_on_the_edges_of_both_ranges() {
    let ranges = [(12.0, 12.33), (47.0, 55.0)];
    let curves = bifurcation_curves(&bench(), "drive.shaker.amplitude", ranges, 1e-9);
    let fold = curves
        .iter()
        .find(|curve| curve.kind == CurveKind::Bifurcation(BranchKind::Fold))
        .unwrap();
    assert!(fold.failures.is_empty(), "{:?}", fold.failures);
    let ends = [&fold.points[0], &fold.points[fold.points.len() - 1]];
    for end in ends {
        eprintln!("{:.9} Hz, {:.6} N", end.parameter, end.parameter_2);
        let is_edge =
            [12.0, 12.33].contains(&end.parameter) || [47.0, 55.0].contains(&end.parameter_2);
        assert!(is_edge, "{end:?}");
    }
    assert!(ends.iter().any(|end| end.parameter == 12.33), "{ends:?}");
    assert!(fold.points.windows(2).all(|pair| pair[0] != pair[1]));
}
