//! Curves over a complete plane: all are found, each once.

use crate::harvesters::bench;
use jounce_analysis::{BifurcationCurve, BifurcationSearch, BranchKind, CurveKind, Model};
use jounce_spec::SpecFile;

fn curves(file: &SpecFile, keys: [(&str, (f64, f64)); 2], seeds: usize) -> Vec<BifurcationCurve> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let numeric = keys.map(|(key, _)| file.numeric_key(key).unwrap());
    let ranges = keys.map(|(_, range)| range);
    let search = BifurcationSearch {
        base: &base,
        keys: [&numeric[0], &numeric[1]],
        ranges,
        tolerance: 1e-9,
        seeds,
        longest_period: 1,
        peaks: false,
    };
    search.run().unwrap()
}

/// Gap against amplitude at 12 Hz, with either key first: equal curves with equal ends. They
/// include the fold of the large orbit across the corner, which crosses only one edge of each
/// range.
#[test]
fn the_order_of_the_keys_has_no_effect() {
    let mut file = bench();
    file.set("drive.shaker.frequency", "12 Hz").unwrap();
    let (gap, amplitude) = (
        ("stop.tip.gap", (0.5e-3, 3e-3)),
        ("drive.shaker.amplitude", (20.0, 80.0)),
    );
    let ends = |curve: &BifurcationCurve, first: usize| {
        let position = |k: usize| {
            let point = &curve.points[k];
            let keys = [point.parameter, point.parameter_2];
            (keys[first] / 2.5e-3, keys[1 - first] / 60.0)
        };
        let mut ends = [position(0), position(curve.points.len() - 1)];
        ends.sort_by(|a, b| a.1.total_cmp(&b.1));
        (curve.kind.name(), ends)
    };
    let mut one: Vec<_> = curves(&file, [gap, amplitude], 4)
        .iter()
        .map(|curve| ends(curve, 0))
        .collect();
    let mut two: Vec<_> = curves(&file, [amplitude, gap], 4)
        .iter()
        .map(|curve| ends(curve, 1))
        .collect();
    for curves_found in [&mut one, &mut two] {
        curves_found.sort_by(|a, b| (a.0, a.1[0].1).partial_cmp(&(b.0, b.1[0].1)).unwrap());
    }
    assert!(
        one.len() == two.len() && one.iter().filter(|(kind, _)| *kind == "fold").count() == 2,
        "{one:?} {two:?}"
    );
    for ((kind, a), (other, b)) in one.iter().zip(&two) {
        let distance = (0..2)
            .map(|k| (a[k].0 - b[k].0).abs().max((a[k].1 - b[k].1).abs()))
            .fold(0.0, f64::max);
        eprintln!("{kind}: {a:?}, off by {distance:.1e}");
        assert!(kind == other && distance < 1e-5);
    }
}

/// Two arms of a curve of tori meet at stiffness 4893.1, where a contact grazes, at a very small
/// angle. Continuation may miss the turn and return over its points. No curve ends on its start,
/// and that one is listed once and complete.
#[test]
#[ignore = "long: runs with ./test --long"]
fn no_curve_comes_back_over_its_own_points() {
    let keys = [
        ("drive.shaker.frequency", (12.5, 14.0)),
        ("stop.tip.stiffness", (4780.0, 5000.0)),
    ];
    let curves_found = curves(&bench(), keys, 4);
    let tori: Vec<&BifurcationCurve> = curves_found
        .iter()
        .filter(|curve| curve.kind == CurveKind::Bifurcation(BranchKind::NeimarkSacker))
        .collect();
    let ends = |curve: &BifurcationCurve| {
        [0, curve.points.len() - 1]
            .map(|k| (curve.points[k].parameter, curve.points[k].parameter_2))
    };
    let separation = |[a, b]: [(f64, f64); 2]| (a.0 - b.0).abs() / 1.5 + (a.1 - b.1).abs() / 220.0;
    for curve in &tori {
        eprintln!(
            "{:?}, {} points, {:?}",
            ends(curve),
            curve.points.len(),
            curve.failures
        );
    }
    assert!(
        tori.iter()
            .all(|curve| separation(ends(curve)) > 1e-3 && curve.failures.is_empty())
    );
    let at_low_edge = |curve: &&&BifurcationCurve| {
        ends(curve)
            .iter()
            .any(|end| (end.0 - 12.725_849).abs() < 1e-4)
    };
    assert_eq!(tori.iter().filter(at_low_edge).count(), 1);
}
