//! Two curves of grazings that join in a cusp.

use super::bifurcation_curves;
use crate::harvesters::{bench, branches};
use jounce_analysis::{BifurcationCurve, BranchKind, CurveKind, OrbitMethodKind};

/// Frequencies of the bifurcations of one kind along the branches at a stiffness.
fn along_the_branch(stiffness: f64, range: (f64, f64), kind: BranchKind) -> Vec<f64> {
    let mut changed = bench();
    changed
        .set("stop.tip.stiffness", &format!("\"{stiffness} N/m^1.5\""))
        .unwrap();
    let along = branches(&changed, range, OrbitMethodKind::Shooting, 0);
    let labels = along
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == kind);
    labels.map(|label| label.at.parameter).collect()
}

/// Curves of one kind over the stiffness, each without a failure.
fn over_the_stiffness(
    start_n_m: f64,
    range: (f64, f64),
    stiffness: (f64, f64),
    kind: BranchKind,
) -> Vec<BifurcationCurve> {
    let mut file = bench();
    file.set("stop.tip.stiffness", &format!("\"{start_n_m} N/m^1.5\""))
        .unwrap();
    let curves: Vec<BifurcationCurve> =
        bifurcation_curves(&file, "stop.tip.stiffness", [range, stiffness], 1e-9)
            .into_iter()
            .filter(|curve| curve.kind == CurveKind::Bifurcation(kind))
            .collect();
    for curve in &curves {
        let ends = [curve.points[0], curve.points[curve.points.len() - 1]]
            .map(|end| (end.parameter, end.parameter_2));
        eprintln!(
            "{kind:?}: {} points from {:?} to {:?}, {:?}",
            curve.points.len(),
            ends[0],
            ends[1],
            curve.failures
        );
        assert!(curve.failures.is_empty() && curve.points.len() < 150);
    }
    curves
}

/// Two turning points of the motion meet on the surface of the stop. Near 12.6926 Hz and 3906
/// N/m^1.5 two curves of grazings join in a cusp. Its sheets separate with the power 3/2 of the
/// distance, as those of `t^3 + a t + b` with a double zero do.
#[test]
fn a_curve_of_grazings_goes_through_its_cusp() {
    let (range, stiffness) = ((12.5, 13.6), (3700.0, 4400.0));
    let curves = over_the_stiffness(4200.0, range, stiffness, BranchKind::Grazing);
    let least = |curve: &&BifurcationCurve| {
        curve
            .points
            .iter()
            .map(|point| point.parameter_2)
            .fold(f64::INFINITY, f64::min)
    };
    let curve = curves
        .iter()
        .find(|curve| least(curve) > stiffness.0)
        .unwrap();
    let cusp = least(&curve);
    let along = along_the_branch(stiffness.1, range, BranchKind::Grazing);
    let sheets = |stiffness: f64| {
        let mut sheets: Vec<f64> = curve
            .crossings(stiffness)
            .iter()
            .map(|(hz, _)| *hz)
            .collect();
        sheets.sort_by(f64::total_cmp);
        assert_eq!(sheets.len(), 2, "at {stiffness}");
        sheets
    };
    for hz in sheets(stiffness.1) {
        let distance = along
            .iter()
            .map(|other| (other - hz).abs())
            .fold(f64::INFINITY, f64::min);
        eprintln!(
            "{hz:.9} Hz, {distance:.1e} Hz from the branch at {} N/m^1.5",
            stiffness.1
        );
        assert!(distance < 1e-6);
    }
    assert!(
        along_the_branch(stiffness.0, range, BranchKind::Grazing).len() + 2 == along.len(),
        "below the cusp there are two less"
    );
    let separation = |offset: f64| {
        let sheets = sheets(cusp + offset);
        sheets[1] - sheets[0]
    };
    let ratio = separation(400.0) / separation(100.0);
    eprintln!(
        "cusp at {cusp} N/m^1.5, sheets part by {:.3e} and {:.3e} Hz: ratio {ratio}",
        separation(100.0),
        separation(400.0)
    );
    assert!((ratio / 8.0 - 1.0).abs() < 0.15);
}
