//! Harmonic balance against shooting: the same orbits within its own error estimate.

use crate::harvesters::bench;
use jounce::contact::{Hertz, HuntCrossley, KelvinVoigt, Law, Rigid};
use jounce::continuation::{Corrector, Metric, Position, settle};
use jounce::orbit::{HarmonicBalance, Harvester, OrbitError, OrbitMethod, Shooting};
use jounce::plant::System;
use jounce::study::settled_orbit;

const CORRECTOR: Corrector = Corrector { goal: 1e-10, most: 20 };

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
        for samples in [128, 512, 2048] {
            let shooting = Shooting::new(&harvester, &kernel, 1, 1e-11);
            let method = HarmonicBalance::new(shooting, &kernel, samples).unwrap();
            let position = Position { unknown: method.unknown_of(exact.start(), 11.0).unwrap(), parameter: 11.0 };
            let found = settle(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            let orbit = method.orbit(&found.local, found.error).unwrap();
            let error = (orbit.mean_power_w / exact.mean_power_w - 1.0).abs();
            let norm = |v: &mut dyn Iterator<Item = f64>| v.map(|x| x * x).sum::<f64>().sqrt();
            let state = norm(&mut orbit.start().iter().zip(exact.start()).map(|(a, b)| a - b)) / norm(&mut exact.start().iter().copied());
            eprintln!("{name}, {samples} samples: power off by {error:.1e}, state by {state:.1e}, estimate {:.1e}", orbit.error_estimate);
            assert!((0.3..3.0).contains(&(orbit.error_estimate / state)), "{name}: {state:e}");
            assert!(state < 0.5 * last, "{name}: {state:e} after {last:e}");
            last = state;
        }
        if name == "hertz" {
            assert!(last < 1e-6, "{last:e}");
        }
    }
}

#[test]
fn a_rigid_stop_is_refused_with_the_other_method_named() {
    let law = Law::Rigid(Rigid { restitution: 0.8 });
    let harvester = crate::harvesters::Systems(|frequency_hz| system(frequency_hz, law));
    let kernel = harvester.at(11.0).unwrap().kernel;
    let refused = HarmonicBalance::new(Shooting::new(&harvester, &kernel, 1, 1e-9), &kernel, 64).err().unwrap();
    assert!(matches!(refused, OrbitError::Impulsive { .. }) && refused.to_string().contains("shooting"), "{refused}");
}
