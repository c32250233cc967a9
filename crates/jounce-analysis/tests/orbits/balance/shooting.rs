//! Harmonic balance against shooting: equal orbits within its error estimate.

use super::{CORRECTOR, HERTZ, norm, refined, state_difference, system};
use crate::harvesters::{Systems, bench, branches};
use jounce_analysis::{BranchKind, Model, OrbitMethodKind, Parameter, settled_orbit};
use jounce_continuation::{Metric, Position, correct_at};
use jounce_model::contact::{HuntCrossley, KelvinVoigt, Law};
use jounce_orbits::{HarmonicBalance, OrbitMethod, ParametricModel, Shooting};

const LAWS: [(&str, Law); 3] = [
    ("hertz", Law::Hertz(HERTZ)),
    (
        "hunt-crossley",
        Law::HuntCrossley(HuntCrossley {
            elastic: HERTZ,
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
];

#[test]
fn balance_agrees_with_shooting_within_its_estimate() {
    for (name, law) in LAWS {
        let harvester = Systems(|frequency_hz| system(frequency_hz, law));
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
            let state = state_difference(&orbit, &exact) / norm(&mut exact.start().iter().copied());
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
        let method = HarmonicBalance::new(shooting, &base.kernel, 64, 3e-8).unwrap();
        let (method, solution) = refined(method, point.orbit.start(), point.parameter);
        let orbit = method.orbit(&solution.local, solution.error).unwrap();
        let power_error = (orbit.mean_power_w / point.orbit.mean_power_w - 1.0).abs();
        let allowed = orbit.error_estimate + point.orbit.error_estimate;
        let state =
            state_difference(&orbit, &point.orbit) / norm(&mut orbit.start().iter().copied());
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
