//! Harmonic balance against shooting: the same orbits within its own error estimate.

use crate::harvesters::{bench, branches};
use jounce::contact::{Hertz, HuntCrossley, KelvinVoigt, Law, Rigid};
use jounce::continuation::{Corrector, Metric, Position, settle};
use jounce::orbit::{HarmonicBalance, Harvester, OrbitError, OrbitMethod, Shooting};
use jounce::plant::System;
use jounce::study::{BranchKind, Method, Parameter, Prepared, settled_orbit};

const CORRECTOR: Corrector = Corrector { goal: 1e-10, most: 20 };

fn norm(values: &mut dyn Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}

fn system(frequency_hz: f64, law: Law) -> System {
    let spec = bench().spec().unwrap();
    let mut system = System::assemble(&spec, jounce::structure::modes(&spec).unwrap()).unwrap();
    system.drives[0].frequency_hz = frequency_hz;
    system.stops[0].law = law;
    system
}

#[test]
fn balance_meets_shooting_within_its_own_estimate() {
    let hertz = Hertz { stiffness: 1000.0, exponent: 1.5 };
    for (name, law) in [
        ("hertz", Law::Hertz(hertz)),
        ("hunt-crossley", Law::HuntCrossley(HuntCrossley { elastic: hertz, damping_s_m: 0.1 })),
        ("kelvin-voigt", Law::KelvinVoigt(KelvinVoigt { stiffness_n_m: 100.0, damping_n_s_m: 0.02 })),
    ] {
        let harvester = crate::harvesters::Systems(|frequency_hz| system(frequency_hz, law));
        let kernel = harvester.at(11.0).unwrap().kernel;
        let exact = settled_orbit(&harvester, 11.0, &vec![0.0; kernel.plant.len()], 1e-11, 1e-10).unwrap();
        let mut last = f64::INFINITY;
        for harmonics in [16, 48, 144] {
            let shooting = Shooting::new(&harvester, &kernel, 1, 1e-11);
            let method = HarmonicBalance::new(shooting, &kernel, harmonics, 0.0).unwrap();
            let position = Position { unknown: method.unknown_of(exact.start(), 11.0).unwrap(), parameter: 11.0 };
            let found = settle(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            let orbit = method.orbit(&found.local, found.error).unwrap();
            let error = (orbit.mean_power_w / exact.mean_power_w - 1.0).abs();
            let state = norm(&mut orbit.start().iter().zip(exact.start()).map(|(a, b)| a - b)) / norm(&mut exact.start().iter().copied());
            let estimate = orbit.error_estimate;
            eprintln!("{name}, {harmonics} harmonics: power off by {error:.1e}, state by {state:.1e}, estimate {estimate:.1e}");
            assert!(state < 3.0 * estimate + 1e-9 && estimate < 3.0 * state + 1e-9, "{name}: {state:e} {estimate:e}");
            assert!(state < (0.5 * last).max(1e-9), "{name}: {state:e} after {last:e}");
            last = state;
        }
        if name != "kelvin-voigt" {
            assert!(last < 1e-8, "{last:e}");
        }
    }
}

/// At points of the branch that shooting follows, stable or not, the states of both methods differ by less than the sum of their estimates,
/// and their powers by less than a millionth.
#[test]
fn both_methods_agree_along_the_whole_branch() {
    let file = bench();
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 16.0);
    let curve = &branches(&file, (4.0, 20.0), Method::Shooting, 0)[0];
    let mut worst = 0.0_f64;
    for point in curve.points.iter().step_by(11) {
        let shooting = Shooting::new(&parameter, &base.kernel, 1, 1e-10);
        let mut method = HarmonicBalance::new(shooting, &base.kernel, 64, 1e-8).unwrap();
        let orbit = loop {
            let position =
                Position { unknown: method.unknown_of(point.orbit.start(), point.parameter).unwrap(), parameter: point.parameter };
            let found = settle(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            match method.finer(&found.local, 0.8).unwrap() {
                Some(finer) => method = finer,
                None => break method.orbit(&found.local, found.error).unwrap(),
            }
        };
        let apart = (orbit.mean_power_w / point.orbit.mean_power_w - 1.0).abs();
        let allowed = orbit.error_estimate + point.orbit.error_estimate;
        let state = norm(&mut orbit.start().iter().zip(point.orbit.start()).map(|(a, b)| a - b)) / norm(&mut orbit.start().iter().copied());
        let (at, harmonics) = (point.parameter, method.harmonics);
        eprintln!("{at:.6} Hz, {harmonics} harmonics: power apart by {apart:.1e}, state by {state:.1e}, estimates {allowed:.1e}");
        assert!(state < allowed && apart < 1e-6 && harmonics < 1024, "{at} Hz: {state:e} > {allowed:e}");
        worst = worst.max(apart / allowed);
    }
    eprintln!("largest difference of the powers: {worst:.2} of the sum of the estimates");
}

#[test]
fn folds_are_those_of_shooting_and_no_others() {
    let file = bench();
    let found = [Method::Shooting, Method::HarmonicBalance { harmonics: 64 }].map(|method| {
        let all = branches(&file, (11.5, 12.5), method, 0).remove(0).bifurcations;
        all.into_iter().map(|found| (found.kind, found.at.parameter, found.at.orbit.mean_power_w)).collect::<Vec<_>>()
    });
    eprintln!("{found:?}");
    assert!(found[0].len() == found[1].len() && found[0].iter().filter(|(kind, ..)| *kind == BranchKind::Fold).count() == 2);
    for (a, b) in found[0].iter().zip(&found[1]) {
        assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-5, "{a:?} {b:?}");
    }
}

#[test]
fn a_rigid_stop_is_refused_with_the_other_method_named() {
    let law = Law::Rigid(Rigid { restitution: 0.8 });
    let harvester = crate::harvesters::Systems(|frequency_hz| system(frequency_hz, law));
    let kernel = harvester.at(11.0).unwrap().kernel;
    let refused = HarmonicBalance::new(Shooting::new(&harvester, &kernel, 1, 1e-9), &kernel, 64, 1e-7).err().unwrap();
    assert!(matches!(refused, OrbitError::Impulsive { .. }) && refused.to_string().contains("shooting"), "{refused}");
}
