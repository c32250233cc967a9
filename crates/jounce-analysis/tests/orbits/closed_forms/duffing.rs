//! Driven Duffing oscillators against a Runge-Kutta integration of their equation, and against the
//! first harmonic.

use super::duffing_equation::{Oracle, nearest_cusp};
use crate::harvesters::branches;
use jounce_analysis::{
    BifurcationCurve, BifurcationSearch, BranchKind, CurveKind, Model, OrbitMethodKind,
};
use jounce_model::reference::Duffing;
use jounce_spec::SpecFile;
use std::f64::consts::TAU;

/// The spec of the gallery, with its numbers.
fn example(cubic: f64, force: f64) -> (SpecFile, Duffing) {
    let mut file = SpecFile::from_text(include_str!(
        "../../../../../examples/bouncing-and-impact-oscillators/duffing.toml"
    ));
    file.set("stop.spring.cubic_stiffness", &format!("\"{cubic} N/m^3\""))
        .unwrap();
    file.set("drive.shaker.amplitude", &format!("\"{force} N\""))
        .unwrap();
    let spec = file.spec().unwrap();
    let modes = &spec.modal["oscillator"];
    let duffing = Duffing {
        mass_kg: 1.0,
        frequency_rad_s: TAU * modes.frequency_hz[0],
        damping_ratio: modes.damping_ratio[0],
        cubic_stiffness_n_m3: cubic,
    };
    (file, duffing)
}

/// Both folds of the curve, hardening and softening, by both methods.
#[test]
fn folds_are_those_of_an_independent_integration() {
    for (cubic, force, range) in [(20.0, 1.0, (0.95, 1.4)), (-10.0, 0.6, (0.75, 1.05))] {
        let (file, duffing) = example(cubic, force);
        let w0 = duffing.frequency_rad_s;
        let oracle = Oracle {
            square: w0 * w0,
            damping: 2.0 * duffing.damping_ratio * w0,
            b: cubic,
            force,
        };
        for method in [
            OrbitMethodKind::Shooting,
            OrbitMethodKind::HarmonicBalance { harmonics: 16 },
        ] {
            let branches_found = branches(&file, range, method, 0);
            let folds: Vec<_> = branches_found[0]
                .bifurcations
                .iter()
                .filter(|label| label.kind == BranchKind::Fold)
                .collect();
            assert_eq!(
                (
                    branches_found.len(),
                    folds.len(),
                    branches_found[0].bifurcations.len()
                ),
                (1, 2, 2)
            );
            for fold in folds {
                let start = fold.at.orbit.start();
                let exact = oracle.nearest_fold([start[0] / w0, start[1], TAU * fold.at.parameter]);
                let error = fold.at.parameter / (exact[2] / TAU) - 1.0;
                let swing = fold.at.orbit.max_penetration_m;
                eprintln!(
                    "b {cubic}, {method:?}: fold at {:.9} Hz, swing {swing:.4} m, off by {error:.1e}",
                    fold.at.parameter
                );
                assert!(error.abs() < 1e-8, "{error:e}");
            }
        }
    }
}

/// The first harmonic alone predicts a fold with an error proportional to the square of
/// `b a^2 / w0^2`. Measured: 2.0e-6 and 5.1e-7 at the lower fold, order 1.96.
#[test]
fn folds_of_the_first_harmonic_are_the_limit_of_small_bending() {
    let errors = [0.25, 0.125].map(|scale| {
        // At equal amplitudes, cubic stiffness, force and damping shrink together.
        let (mut file, mut duffing) = example(20.0 * scale, scale);
        duffing.damping_ratio *= scale;
        file.set(
            "modal.oscillator.damping_ratio",
            &format!("[{}]", duffing.damping_ratio),
        )
        .unwrap();
        let branches_found = branches(&file, (0.98, 1.12), OrbitMethodKind::Shooting, 0);
        let folds = branches_found[0]
            .bifurcations
            .iter()
            .filter(|label| label.kind == BranchKind::Fold);
        let exact = folds
            .map(|label| label.at.parameter)
            .fold(f64::INFINITY, f64::min);
        let first = duffing
            .first_harmonic_folds(scale)
            .iter()
            .map(|fold| fold.0 / TAU)
            .fold(f64::INFINITY, f64::min);
        eprintln!("scale {scale}: lower fold {exact:.9} Hz, by the first harmonic {first:.9} Hz");
        first / exact - 1.0
    });
    let order = (errors[0] / errors[1]).log2();
    eprintln!("off by {errors:?}, order {order:.3}");
    assert!(
        errors[0].abs() < 3e-6 && (order - 2.0).abs() < 0.1,
        "{errors:?}, order {order}"
    );
}

/// Along the curve the product of the multipliers equals the area contraction by damping in a
/// period.
#[test]
fn multipliers_multiply_to_the_decay_of_a_period() {
    let (file, duffing) = example(20.0, 1.0);
    let branches_found = branches(&file, (0.95, 1.4), OrbitMethodKind::Shooting, 0);
    let mut worst = 0.0_f64;
    for point in &branches_found[0].points {
        let product = point.orbit.multipliers[0] * point.orbit.multipliers[1];
        let exact =
            (-2.0 * duffing.damping_ratio * duffing.frequency_rad_s / point.parameter).exp();
        worst = worst
            .max((product.re / exact - 1.0).abs())
            .max(product.im.abs());
    }
    eprintln!(
        "{} points, product off by {worst:.1e}",
        branches_found[0].points.len()
    );
    assert!(worst < 1e-8);
}

/// Position, velocity, angular frequency and force at the cusp by the first harmonic:
/// `w^2 - w0^2 = sqrt(3) c`, `f^2 = (4 c^2 / 3) a^2`, `c = 2 zeta w0 w`,
/// `3 b a^2 / 4 = 2 (w^2 - w0^2) / 3`.
fn cusp_by_first_harmonic(w0: f64, zeta: f64, b: f64) -> [f64; 4] {
    let w = w0 * (3.0_f64.sqrt() * zeta + (3.0 * zeta * zeta + 1.0).sqrt());
    let c = 2.0 * zeta * w0 * w;
    let square = 2.0 / 3.0 * 3.0_f64.sqrt() * c / (0.75 * b);
    let force = (4.0 / 3.0 * c * c * square).sqrt();
    // x = a sin(wt + phase): (w0^2 - w^2 + 3 b a^2 / 4) a = f cos phase, c a = -f sin phase.
    let phase = (-c).atan2(-3.0_f64.sqrt() * c / 3.0);
    [
        square.sqrt() * phase.sin(),
        square.sqrt() * w * phase.cos(),
        w,
        force,
    ]
}

/// The only curve over frequency and force, continued from a force.
fn fold_curve(drive_n: f64, ranges: [(f64, f64); 2]) -> BifurcationCurve {
    let (file, _) = example(20.0, drive_n);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let keys = ["drive.shaker.frequency", "drive.shaker.amplitude"]
        .map(|key| file.numeric_key(key).unwrap());
    let search = BifurcationSearch {
        base: &base,
        keys: [&keys[0], &keys[1]],
        ranges,
        tolerance: 1e-9,
        seeds: 0,
        longest_period: 1,
        peaks: false,
    };
    let mut curves = search.run().unwrap();
    assert_eq!(curves.len(), 1);
    curves.remove(0)
}

/// Two folds meet in a cusp where bistability begins. In a plane so narrow that the parameters turn
/// over a thousandth of the motion, the curve is complete, and the cusp is a point of it, as in an
/// independent integration. The arms of the cusp separate with the power 3/2 of the distance.
#[test]
fn a_curve_of_folds_goes_through_its_cusp() {
    let (_, duffing) = example(20.0, 1.0);
    let (w0, zeta) = (duffing.frequency_rad_s, duffing.damping_ratio);
    let first = cusp_by_first_harmonic(w0, zeta, 20.0);
    let w = first[2];
    let exact = nearest_cusp(w0 * w0, 2.0 * zeta * w0, 20.0, first);
    let (hz, force) = (exact[2] / TAU, exact[3]);
    eprintln!(
        "cusp at {hz:.9} Hz, {force:.9} N; by the first harmonic {:.9} Hz, {:.9} N",
        w / TAU,
        first[3]
    );
    assert!((w / exact[2] - 1.0).abs() < 1e-3 && (first[3] / force - 1.0).abs() < 1e-3);

    // Continuation stops before the cusp in one plane, behind it in the other.
    for (drive_n, ranges) in [
        (0.2308, [(1.0172, 1.0178), (0.2303, 0.2313)]),
        (1.0, [(1.016, 1.0185), (0.229, 0.233)]),
    ] {
        let curve = fold_curve(drive_n, ranges);
        let points = &curve.points;
        let ends = [points[0].parameter_2, points[points.len() - 1].parameter_2];
        eprintln!(
            "{:?}: {} points, ends {ends:?}, {:?}",
            curve.kind,
            points.len(),
            curve.failures
        );
        assert_eq!(
            (curve.kind, ends),
            (CurveKind::Bifurcation(BranchKind::Fold), [ranges[1].1; 2])
        );
        assert!(curve.failures.is_empty() && points.len() < 150);
        let turn = points
            .iter()
            .min_by(|a, b| a.parameter_2.total_cmp(&b.parameter_2))
            .unwrap();
        let errors = [turn.parameter / hz - 1.0, turn.parameter_2 / force - 1.0];
        let separation = |distance: f64| {
            let frequencies_hz: Vec<f64> = curve
                .crossings(force + distance)
                .iter()
                .map(|(hz, _)| *hz)
                .collect();
            assert_eq!(frequencies_hz.len(), 2);
            (frequencies_hz[1] - frequencies_hz[0]).abs()
        };
        let ratio = separation(8e-4) / separation(2e-4);
        eprintln!(
            "turns off by {errors:?}; arms part by {:e} Hz at 0.2 mN, {ratio} times that at 0.8 mN",
            separation(2e-4)
        );
        assert!(
            errors.iter().all(|error| error.abs() < 1e-8) && (ratio / 8.0 - 1.0).abs() < 0.05,
            "{errors:?} {ratio}"
        );
    }
}
