//! Orbits whose multipliers, speed or frequency are known exactly.

use crate::harvesters::Systems;
use jounce::continuation::{Corrector, Metric, Position, settle};
use jounce::march::Kernel;
use jounce::orbit::{Harvester, OrbitMethod, Shooting};
use jounce::reference::ImpactOscillator;
use std::f64::consts::TAU;

const CORRECTOR: Corrector = Corrector { goal: 1e-11, most: 12 };

fn oscillator(gap: f64) -> ImpactOscillator {
    ImpactOscillator { frequency_ratio: 0.8, damping_ratio: 0.05, restitution: 0.8, gap }
}

/// The drive starts a third of a cycle after the impact of the orbit at gap 0.5, so that no impact meets the start of a cycle.
fn angle() -> f64 {
    oscillator(0.5).orbits(1)[0].angle_rad + TAU / 3.0
}

#[test]
fn impact_oscillator_has_the_multipliers_and_the_speed_of_the_closed_form() {
    let harvester = Systems(|gap| oscillator(gap).system(angle()));
    for gap in [0.5, 1.0, 2.0] {
        let reference = oscillator(gap);
        let exact = reference.orbits(1).pop().unwrap();
        let kernel = harvester.at(gap).unwrap().kernel;
        let shooting = Shooting::new(&harvester, &kernel, 1, 1e-13);
        // From the impact to the start of the cycle.
        let start_s = (exact.angle_rad - angle()).rem_euclid(TAU) / 0.8;
        let y = kernel.plant.from_physical(&reference.start(&exact), start_s);
        let mut marcher = jounce::march::Marcher::new(&kernel, &y, start_s, 1e-13).unwrap();
        marcher.advance_to(TAU / 0.8).unwrap();
        let guess: Vec<f64> = kernel.plant.to_physical(&marcher.state(), 0.0).iter().map(|x| x * 1.001).collect();
        let position = Position { unknown: shooting.unknown(&guess), parameter: gap };
        let found = settle(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
        let orbit = shooting.orbit(&found.local, found.error).unwrap();
        let (sum, product) = (orbit.multipliers[0] + orbit.multipliers[1], orbit.multipliers[0] * orbit.multipliers[1]);
        let errors = [sum.re - exact.trace_determinant[0], product.re - exact.trace_determinant[1]];
        eprintln!("gap {gap}: {errors:?}, contacts {}, stable {}", orbit.contacts, orbit.is_stable());
        assert!(errors[0].abs() < 1e-8 && errors[1].abs() < 1e-8 && orbit.contacts == 1, "{errors:?}");
        assert_eq!(orbit.is_stable(), exact.is_stable());
    }
}

/// Without contact the orbit is the steady state, and its multipliers are those of the plant over a period.
#[test]
fn orbit_without_contact_is_linear() {
    let harvester = Systems(|gap| oscillator(gap).system(0.0));
    let kernel: Kernel = harvester.at(5.0).unwrap().kernel;
    let shooting = Shooting::new(&harvester, &kernel, 1, 1e-10);
    let position = Position { unknown: vec![0.3, -0.2], parameter: 5.0 };
    let found = settle(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
    let orbit = shooting.orbit(&found.local, found.error).unwrap();
    let steady = shooting.unknown(&kernel.plant.to_physical(&[0.0, 0.0], 0.0));
    assert!(orbit.start().iter().zip(&steady).all(|(a, b)| (a - b).abs() < 1e-9), "{:?} {steady:?}", orbit.start());
    let modulus = (-0.05 * TAU / 0.8_f64).exp();
    assert!((orbit.floquet_max_abs() - modulus).abs() < 1e-12 && orbit.contacts == 0);
}
