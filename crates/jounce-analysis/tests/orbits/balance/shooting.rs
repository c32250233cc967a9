//! Harmonic balance against shooting: equal orbits within its error estimate.

use crate::harvesters::{bench, branches};
use jounce_analysis::{BranchKind, Model, OrbitMethodKind, Parameter, settled_orbit};
use jounce_continuation::{
    ContinuationError, Corrector, Linearization, Metric, Position, Problem, correct_at,
};
use jounce_model::contact::{Hertz, HuntCrossley, KelvinVoigt, Law, Rigid};
use jounce_model::plant::System;
use jounce_orbits::{HarmonicBalance, OrbitError, OrbitMethod, ParametricModel, Shooting};
use jounce_spec::SpecFile;

const CORRECTOR: Corrector = Corrector {
    goal: 1e-10,
    most: 20,
};

fn norm(values: &mut dyn Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}

fn system(frequency_hz: f64, law: Law) -> System {
    let spec = bench().spec().unwrap();
    let mut system =
        System::assemble(&spec, jounce_model::structure::modes(&spec).unwrap()).unwrap();
    system.drives[0].frequency_hz = frequency_hz;
    system.stops[0].law = law;
    system
}

#[test]
fn balance_agrees_with_shooting_within_its_estimate() {
    let hertz = Hertz {
        stiffness: 1000.0,
        exponent: 1.5,
    };
    for (name, law) in [
        ("hertz", Law::Hertz(hertz)),
        (
            "hunt-crossley",
            Law::HuntCrossley(HuntCrossley {
                elastic: hertz,
                damping_s_m: 0.1,
            }),
        ),
        (
            "kelvin-voigt",
            Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: 100.0,
                damping_n_s_m: 0.02,
            }),
        ),
    ] {
        let harvester = crate::harvesters::Systems(|frequency_hz| system(frequency_hz, law));
        let kernel = harvester.at(11.0).unwrap().kernel;
        let exact = settled_orbit(
            &harvester,
            11.0,
            &vec![0.0; kernel.plant.len()],
            1e-11,
            1e-10,
        )
        .unwrap();
        let mut last = f64::INFINITY;
        for harmonics in [16, 48, 144] {
            let shooting = Shooting::new(&harvester, &kernel, 1, 1e-11);
            let method = HarmonicBalance::new(shooting, &kernel, harmonics, 0.0).unwrap();
            let position = Position {
                unknown: method.unknown_of(exact.start(), 11.0).unwrap(),
                parameter: 11.0,
            };
            let solution =
                correct_at(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            let orbit = method.orbit(&solution.local, solution.error).unwrap();
            let error = (orbit.mean_power_w / exact.mean_power_w - 1.0).abs();
            let state = norm(&mut orbit.start().iter().zip(exact.start()).map(|(a, b)| a - b))
                / norm(&mut exact.start().iter().copied());
            let estimate = orbit.error_estimate;
            eprintln!(
                "{name}, {harmonics} harmonics: power off by {error:.1e}, state by {state:.1e}, estimate {estimate:.1e}"
            );
            let largest = state.max(error);
            assert!(
                largest < 3.0 * estimate + 1e-9 && estimate < 3.0 * largest + 1e-9,
                "{name}: {largest:e} {estimate:e}"
            );
            assert!(
                state < (0.5 * last).max(1e-9),
                "{name}: {state:e} after {last:e}"
            );
            last = state;
        }
        if name != "kelvin-voigt" {
            assert!(last < 1e-8, "{last:e}");
        }
    }
}

/// Compares points of the branch that shooting follows, stable or not. States and mean powers of the
/// two methods differ by less than the sum of their estimates, and the powers by less than a
/// millionth.
#[test]
fn both_methods_agree_along_the_complete_branch() {
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 16.0);
    let curve = &branches(&file, (4.0, 20.0), OrbitMethodKind::Shooting, 0)[0];
    let mut worst = 0.0_f64;
    for point in curve.points.iter().step_by(5) {
        let shooting = Shooting::new(&parameter, &base.kernel, 1, 1e-10);
        let mut method = HarmonicBalance::new(shooting, &base.kernel, 64, 3e-8).unwrap();
        let orbit = loop {
            let position = Position {
                unknown: method
                    .unknown_of(point.orbit.start(), point.parameter)
                    .unwrap(),
                parameter: point.parameter,
            };
            let solution =
                correct_at(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            match method
                .finer()
                .filter(|_| method.error_ratio(&solution.local, 0.8).unwrap() > 1.0)
            {
                Some(finer) => method = finer,
                None => break method.orbit(&solution.local, solution.error).unwrap(),
            }
        };
        let power_error = (orbit.mean_power_w / point.orbit.mean_power_w - 1.0).abs();
        let allowed = orbit.error_estimate + point.orbit.error_estimate;
        let state = norm(
            &mut orbit
                .start()
                .iter()
                .zip(point.orbit.start())
                .map(|(a, b)| a - b),
        ) / norm(&mut orbit.start().iter().copied());
        let (at, harmonics) = (point.parameter, method.harmonics);
        eprintln!(
            "{at:.6} Hz, {harmonics} harmonics: power apart by {power_error:.1e}, state by {state:.1e}, estimates {allowed:.1e}"
        );
        assert!(
            state < allowed && power_error < allowed && power_error < 1e-6 && harmonics < 512,
            "{at} Hz: {state:e}, {power_error:e} > {allowed:e}"
        );
        worst = worst.max(power_error / allowed);
    }
    eprintln!("largest difference of the powers: {worst:.2} of the sum of the estimates");
}

#[test]
fn folds_are_those_of_shooting_and_no_others() {
    let file = bench();
    let by_method = [
        OrbitMethodKind::Shooting,
        OrbitMethodKind::HarmonicBalance { harmonics: 64 },
    ]
    .map(|method| {
        let all = branches(&file, (11.5, 12.5), method, 0)
            .remove(0)
            .bifurcations;
        all.into_iter()
            .map(|label| (label.kind, label.at.parameter, label.at.orbit.mean_power_w))
            .collect::<Vec<_>>()
    });
    eprintln!("{by_method:?}");
    assert!(
        by_method[0].len() == by_method[1].len()
            && by_method[0]
                .iter()
                .filter(|(kind, ..)| *kind == BranchKind::Fold)
                .count()
                == 2
    );
    for (a, b) in by_method[0].iter().zip(&by_method[1]) {
        assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-5, "{a:?} {b:?}");
    }
}

/// The complete branch with an adaptive number of harmonics: exactly the folds, doublings, tori and
/// grazings of shooting.
#[test]
fn labels_of_the_complete_branch_are_those_of_shooting() {
    let file = bench();
    let by_method = [
        OrbitMethodKind::Shooting,
        OrbitMethodKind::HarmonicBalance { harmonics: 64 },
    ]
    .map(|method| branches(&file, (4.0, 20.0), method, 0).remove(0));
    let [one, two] = by_method.each_ref().map(|branch| &branch.bifurcations);
    assert_eq!(one.len(), two.len());
    for (a, b) in one.iter().zip(two) {
        let (at, other) = (&a.at, &b.at);
        assert!(
            a.kind == b.kind && (at.parameter - other.parameter).abs() < 1e-6,
            "{:?} {} {}",
            a.kind,
            at.parameter,
            other.parameter
        );
        assert!(
            (at.orbit.mean_power_w / other.orbit.mean_power_w - 1.0).abs() < 1e-5,
            "{:?} at {} Hz",
            a.kind,
            at.parameter
        );
    }
    let worst = by_method[1]
        .points
        .iter()
        .map(|point| point.orbit.error_estimate)
        .fold(0.0, f64::max);
    eprintln!(
        "{} labels, {} and {} points, largest estimate {worst:.1e}",
        one.len(),
        by_method[0].points.len(),
        by_method[1].points.len()
    );
    assert!(worst < 1e-5, "{worst:e}");
}

/// The number of harmonics increases by a half and decreases by a third, between limits.
#[test]
fn the_number_of_harmonics_has_two_limits() {
    let harvester = crate::harvesters::Systems(|frequency_hz| {
        system(
            frequency_hz,
            Law::Hertz(Hertz {
                stiffness: 1000.0,
                exponent: 1.5,
            }),
        )
    });
    let kernel = harvester.at(11.0).unwrap().kernel;
    let method = |harmonics: usize| {
        HarmonicBalance::new(
            Shooting::new(&harvester, &kernel, 1, 1e-9),
            &kernel,
            harmonics,
            3e-7,
        )
        .unwrap()
    };
    assert_eq!(method(64).finer().map(|finer| finer.harmonics), Some(96));
    assert_eq!(
        method(96).coarser().map(|coarser| coarser.harmonics),
        Some(64)
    );
    assert!(method(1000).finer().is_none() && method(20).coarser().is_none());
    assert_eq!(method(16).resampled(&[1.0; 65]), [1.0; 33]);
}

#[test]
fn a_rigid_stop_is_refused_with_the_other_method_named() {
    let law = Law::Rigid(Rigid { restitution: 0.8 });
    let harvester = crate::harvesters::Systems(|frequency_hz| system(frequency_hz, law));
    let kernel = harvester.at(11.0).unwrap().kernel;
    let refused = HarmonicBalance::new(
        Shooting::new(&harvester, &kernel, 1, 1e-9),
        &kernel,
        64,
        1e-7,
    )
    .err()
    .unwrap();
    assert!(
        matches!(refused, OrbitError::Impulsive { .. }) && refused.to_string().contains("shooting"),
        "{refused}"
    );
}

/// Derivatives by the parameter in closed form against differences: frequency, amplitude, gap and
/// stiffness.
#[test]
fn the_change_with_the_parameter_is_that_of_differences() {
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    for (name, value) in [
        ("drive.shaker.frequency", 11.0),
        ("drive.shaker.amplitude", 50.0),
        ("stop.tip.gap", 1e-3),
        ("stop.tip.stiffness", 1000.0),
    ] {
        let key = file.numeric_key(name).unwrap();
        let parameter = Parameter::new(&base, &key, value);
        let kernel = parameter.at(value).unwrap().kernel;
        let exact = settled_orbit(
            &parameter,
            value,
            &vec![0.0; kernel.plant.len()],
            1e-10,
            1e-9,
        )
        .unwrap();
        let method = HarmonicBalance::new(
            Shooting::new(&parameter, &kernel, 1, 1e-10),
            &kernel,
            64,
            1e-8,
        )
        .unwrap();
        let unknown = method.unknown_of(exact.start(), value).unwrap();
        let none = vec![0.0; unknown.len()];
        // At fixed parameter the bordered solution is `-R_u^-1 R_p`.
        let (along, _) = method
            .at(&unknown, value)
            .unwrap()
            .bordered(&none, 1.0, &none, 1.0)
            .unwrap();
        let step = 1e-6 * value;
        let residual = |parameter: f64| method.at(&unknown, parameter).unwrap().residual().to_vec();
        let change: Vec<f64> = residual(value + step)
            .iter()
            .zip(&residual(value - step))
            .map(|(a, b)| (b - a) / (2.0 * step))
            .collect();
        let (by_difference, _) = method
            .at(&unknown, value)
            .unwrap()
            .bordered(&none, 1.0, &change, 0.0)
            .unwrap();
        let error = norm(&mut along.iter().zip(&by_difference).map(|(a, b)| a - b))
            / norm(&mut along.iter().copied());
        eprintln!("{name}: {error:.1e}");
        // At most 3e-10; 3e-7 for the gap, whose contact edges move the nodes and so change the
        // quadrature error in the difference.
        assert!(error < 1e-6, "{name}: {error:e}");
    }
}

/// The problem size is independent of the number of modes of the plant: harmonics, nodes in
/// contact, Newton evaluations.
#[test]
fn the_work_at_a_point_is_flat_in_the_number_of_modes() {
    let mut report = String::new();
    for modes in [8, 24, 40] {
        let mut file = SpecFile::from_text(include_str!(
            "../../../../../examples/impact-harvester-2019/harvester.toml"
        ));
        file.set("reduction.modes", &modes.to_string()).unwrap();
        let known = [0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.0016];
        let ratios: Vec<f64> = (0..modes - 1).map(|mode| known[mode.min(6)]).collect();
        file.set("damping.ratios", &format!("{ratios:?}")).unwrap();
        file.set("drive.shaker.amplitude", "\"50 N\"").unwrap();
        let base = Model::new(file.spec().unwrap()).unwrap();
        let key = file.numeric_key("drive.shaker.frequency").unwrap();
        let parameter = Parameter::new(&base, &key, 16.0);
        let kernel = parameter.at(11.0).unwrap().kernel;
        let start =
            settled_orbit(&parameter, 11.0, &vec![0.0; kernel.plant.len()], 1e-9, 1e-8).unwrap();
        let mut method = HarmonicBalance::new(
            Shooting::new(&parameter, &kernel, 1, 1e-9),
            &kernel,
            64,
            3e-7,
        )
        .unwrap();
        let (solution, evaluations) = loop {
            let position = Position {
                unknown: method.unknown_of(start.start(), 11.0).unwrap(),
                parameter: 11.0,
            };
            let solution =
                correct_at(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            match method
                .finer()
                .filter(|_| method.error_ratio(&solution.local, 0.8).unwrap() > 1.0)
            {
                Some(finer) => method = finer,
                None => break (solution.local, solution.evaluations),
            }
        };
        report += &format!(
            "{modes} modes: {} harmonics, {} nodes, {evaluations} evaluations\n",
            method.harmonics,
            solution.nodes()
        );
    }
    insta::assert_snapshot!(report);
}

/// When Newton fails, the error lists the residual by harmonic: for a contact-free orbit, the shift
/// of the third one.
#[test]
fn a_failure_reports_the_residual_by_harmonic() {
    let law = Law::Hertz(Hertz {
        stiffness: 1000.0,
        exponent: 1.5,
    });
    let harvester = crate::harvesters::Systems(|frequency_hz| {
        let mut system = system(frequency_hz, law);
        system.stops[0].gap_m = 0.5;
        system
    });
    let kernel = harvester.at(11.0).unwrap().kernel;
    let method = HarmonicBalance::new(
        Shooting::new(&harvester, &kernel, 1, 1e-11),
        &kernel,
        16,
        0.0,
    )
    .unwrap();
    let steady = method.shooting.unknown(
        &kernel
            .plant
            .to_physical(&vec![0.0; kernel.plant.len()], 0.0),
    );
    let mut unknown = method.unknown_of(&steady, 11.0).unwrap();
    (unknown[5], unknown[6]) = (unknown[5] + 3e-7, unknown[6] - 4e-7);
    let position = Position {
        unknown,
        parameter: 11.0,
    };
    let one_iteration = Corrector {
        goal: 1e-10,
        most: 1,
    };
    let failed = correct_at(
        &method,
        &one_iteration,
        &Metric::at(&position, 1.0),
        position,
    )
    .unwrap_err();
    let ContinuationError::Diverged { left, .. } = &failed else {
        panic!("{failed}")
    };
    let [mean, first, second, third, ..] = &left.sizes[..] else {
        panic!("{left:?}")
    };
    assert!(
        third.0 == "harmonic 3" && (third.1 / 5e-7 - 1.0).abs() < 1e-6,
        "{third:?}"
    );
    assert!(
        mean.1.max(first.1).max(second.1) < 1e-12 && left.sizes.len() == 17,
        "{left:?}"
    );
    assert!(
        failed
            .to_string()
            .contains("largest in harmonic 3 5.0e-7 m rms"),
        "{failed}"
    );
}
