//! Orbits whose multipliers, speed or frequency are known exactly.

use crate::harvesters::Systems;
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_dynamics::Kernel;
use jounce_model::reference::ImpactOscillator;
use jounce_orbits::{OrbitMethod, ParametricModel, Shooting};
use std::f64::consts::TAU;

const CORRECTOR: Corrector = Corrector {
    goal: 1e-11,
    most: 12,
};

fn oscillator(gap: f64) -> ImpactOscillator {
    ImpactOscillator {
        frequency_ratio: 0.8,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap,
    }
}

/// The drive starts a third of a cycle after the impact of the orbit at gap 0.5, so no impact falls
/// on the start of a cycle.
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
        let y = kernel
            .plant
            .from_physical(&reference.start(&exact), start_s);
        let mut integrator = jounce_dynamics::Integrator::new(&kernel, &y, start_s, 1e-13).unwrap();
        integrator.advance_to(TAU / 0.8).unwrap();
        let guess: Vec<f64> = kernel
            .plant
            .to_physical(&integrator.state(), 0.0)
            .iter()
            .map(|x| x * 1.001)
            .collect();
        let position = Position {
            unknown: shooting.unknown(&guess),
            parameter: gap,
        };
        let solution =
            correct_at(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
        let orbit = shooting.orbit(&solution.local, solution.error).unwrap();
        let (sum, product) = (
            orbit.multipliers[0] + orbit.multipliers[1],
            orbit.multipliers[0] * orbit.multipliers[1],
        );
        let errors = [
            sum.re - exact.trace_determinant[0],
            product.re - exact.trace_determinant[1],
        ];
        eprintln!(
            "gap {gap}: {errors:?}, contacts {}, stable {}",
            orbit.contacts,
            orbit.is_stable()
        );
        assert!(
            errors[0].abs() < 1e-8 && errors[1].abs() < 1e-8 && orbit.contacts == 1,
            "{errors:?}"
        );
        assert_eq!(orbit.is_stable(), exact.is_stable());
    }
}

/// Without contact the orbit is the steady state, and its multipliers are those of the plant over a
/// period.
#[test]
fn orbit_without_contact_is_linear() {
    let harvester = Systems(|gap| oscillator(gap).system(0.0));
    let kernel: Kernel = harvester.at(5.0).unwrap().kernel;
    let shooting = Shooting::new(&harvester, &kernel, 1, 1e-10);
    let position = Position {
        unknown: vec![0.3, -0.2],
        parameter: 5.0,
    };
    let solution =
        correct_at(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
    let orbit = shooting.orbit(&solution.local, solution.error).unwrap();
    let steady = shooting.unknown(&kernel.plant.to_physical(&[0.0, 0.0], 0.0));
    assert!(
        orbit
            .start()
            .iter()
            .zip(&steady)
            .all(|(a, b)| (a - b).abs() < 1e-9),
        "{:?} {steady:?}",
        orbit.start()
    );
    let modulus = (-0.05 * TAU / 0.8_f64).exp();
    assert!((orbit.floquet_max_abs() - modulus).abs() < 1e-12 && orbit.contacts == 0);
}

/// Half the distance between the surface of the stop and the lowest point of the closed-form motion
/// between two impacts.
#[test]
fn impact_oscillator_swings_as_far_as_its_closed_form() {
    for (gap, after_rad) in [(0.5, TAU / 3.0), (0.5, 1.0), (1.0, 4.0)] {
        let reference = oscillator(gap);
        let exact = reference.orbits(1).pop().unwrap();
        let (w, zeta) = (reference.frequency_ratio, reference.damping_ratio);
        let (size, lag) = (
            reference.steady_amplitude(),
            (2.0 * zeta * w).atan2(1.0 - w * w),
        );
        let steady = |t: f64| {
            [
                size * (w * t + exact.angle_rad - lag).cos(),
                -size * w * (w * t + exact.angle_rad - lag).sin(),
            ]
        };
        let damped = (1.0 - zeta * zeta).sqrt();
        let [x, v] = [
            gap - steady(0.0)[0],
            -reference.restitution * exact.speed - steady(0.0)[1],
        ];
        let at = |t: f64| {
            steady(t)[0]
                + (-zeta * t).exp()
                    * (x * (damped * t).cos() + (v + zeta * x) / damped * (damped * t).sin())
        };
        let lowest = (0..1_000_000)
            .map(|k| at(TAU / w * f64::from(k) * 1e-6))
            .fold(f64::INFINITY, f64::min);
        let angle = exact.angle_rad + after_rad;
        let harvester = Systems(|gap| oscillator(gap).system(angle));
        let kernel = harvester.at(gap).unwrap().kernel;
        let shooting = Shooting::new(&harvester, &kernel, 1, 1e-13);
        let start_s = (-after_rad).rem_euclid(TAU) / w;
        let y = kernel
            .plant
            .from_physical(&reference.start(&exact), start_s);
        let mut integrator = jounce_dynamics::Integrator::new(&kernel, &y, start_s, 1e-13).unwrap();
        integrator.advance_to(TAU / w).unwrap();
        let position = Position {
            unknown: shooting.unknown(&kernel.plant.to_physical(&integrator.state(), 0.0)),
            parameter: gap,
        };
        let solution =
            correct_at(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
        let orbit = shooting.orbit(&solution.local, solution.error).unwrap();
        let error = orbit.displacement_peak_m / (0.5 * (gap - lowest)) - 1.0;
        eprintln!("gap {gap}, {after_rad} rad on: {error:e}");
        assert!(
            error.abs() < 1e-7,
            "gap {gap}: {} {}",
            orbit.displacement_peak_m,
            0.5 * (gap - lowest)
        );
    }
}
