//! Square-root law at a grazing on a rigid stop.
//!
//! With the gap `m` below the steady amplitude `X`, the impact speed is
//! `v = w sqrt(X^2 - (X - m)^2)`, of order `m^(1/2)`. Within a cycle the motion is deflected by
//! this order, and the derivative of the flow grows like `m^(-1/2)`. An orbit with one impact in
//! each cycle adapts: its impact speed is of order `m`, so its largest multiplier grows like
//! `1 / m`.
//!
//! Source: A. B. Nordmark, J. Sound Vib. 145 (1991) 279.

use crate::harvesters::Systems;
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_dynamics::{FlowSensitivity, Integrator, Kernel, ParameterSensitivity};
use jounce_model::plant::Plant;
use jounce_model::reference::ImpactOscillator;
use jounce_orbits::{OrbitMethod, ParametricModel, Shooting};
use std::f64::consts::{PI, TAU};

const CORRECTOR: Corrector = Corrector {
    goal: 1e-12,
    most: 20,
};

fn oscillator(gap: f64) -> ImpactOscillator {
    ImpactOscillator {
        frequency_ratio: 0.8,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap,
    }
}

/// `X`, 2.711631, and the angle of the drive's cosine at the turning point of the steady motion.
fn steady() -> (f64, f64) {
    let any = oscillator(0.0);
    (any.steady_amplitude(), (0.08_f64).atan2(1.0 - 0.64))
}

/// Slope of `ln y` over `ln x` and the largest distance from that line.
fn power_law(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean = logs
        .iter()
        .fold((0.0, 0.0), |sum, p| (sum.0 + p.0 / n, sum.1 + p.1 / n));
    let (top, bottom) = logs.iter().fold((0.0, 0.0), |sum, p| {
        (
            sum.0 + (p.0 - mean.0) * (p.1 - mean.1),
            sum.1 + (p.0 - mean.0).powi(2),
        )
    });
    let slope = top / bottom;
    (
        slope,
        logs.iter()
            .map(|p| (p.1 - mean.1 - slope * (p.0 - mean.0)).abs())
            .fold(0.0, f64::max),
    )
}

/// The harvester with the gap `m` below the amplitude; its drive starts half a cycle before the
/// steady motion reaches the stop.
fn kernel(below: f64) -> Kernel {
    let (amplitude, angle_rad) = steady();
    Kernel::new(Plant::new(oscillator(amplitude - below).system(angle_rad - PI)).unwrap()).unwrap()
}

/// Over a cycle from the steady motion: the deflection, and the impact speed from the energy loss.
#[test]
fn one_cycle_from_the_steady_motion_leaves_it_by_the_square_root() {
    let (amplitude, _) = steady();
    let (mut distances, mut derivatives) = (Vec::new(), Vec::new());
    for decade in 2..=9 {
        let below = 10_f64.powi(-decade);
        let kernel = kernel(below);
        let rest_state = vec![0.0; kernel.plant.len()];
        let mut integrator = Integrator::new(&kernel, &rest_state, 0.0, 1e-12).unwrap();
        integrator.advance_to(TAU / 0.8).unwrap();
        let loss_j = integrator.energies().contact_loss_j;
        let speed = 0.8 * (amplitude * amplitude - (amplitude - below).powi(2)).sqrt();
        let error = (loss_j / (0.5 * (1.0 - 0.64) * speed * speed)).sqrt() - 1.0;
        assert_eq!(integrator.statistics().contacts, 1);
        // `X^2 - d^2` has the roundoff of both terms, and the integration that of the impact
        // position.
        assert!(
            error.abs() < 1e-9 + 4e-15 / below,
            "strikes {error:e} off at {below:e}"
        );
        distances.push((
            below,
            integrator.state().iter().map(|y| y * y).sum::<f64>().sqrt(),
        ));
        let flow = FlowSensitivity::integrate(
            &kernel,
            &rest_state,
            0.0,
            TAU / 0.8,
            1e-12,
            &ParameterSensitivity::default(),
        )
        .unwrap();
        derivatives.push((below, flow.jacobian.norm()));
    }
    let ((distance, scatter), (derivative, derivative_scatter)) =
        (power_law(&distances[2..]), power_law(&derivatives[2..]));
    eprintln!(
        "distance: exponent {distance:.5} (off the line by {scatter:.1e}); derivative: {derivative:.5} ({derivative_scatter:.1e})"
    );
    assert!(
        (distance - 0.5).abs() < 1e-3 && (derivative + 0.5).abs() < 1e-3,
        "{distance} {derivative}"
    );
}

/// Orbits with one impact in a cycle, down to a gap 1e-5 below the amplitude: speed and trace of
/// the closed form.
#[test]
fn multiplier_of_the_impacting_orbit_diverges_towards_its_grazing() {
    let (amplitude, angle_rad) = steady();
    let (mut speeds, mut multipliers) = (Vec::new(), Vec::new());
    let harvester = Systems(|gap| oscillator(gap).system(angle_rad - PI));
    for decade in [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0] {
        let gap = amplitude - 10_f64.powf(-decade);
        let reference = oscillator(gap);
        let exact = reference.orbits(1).pop().unwrap();
        let kernel = harvester.at(gap).unwrap().kernel;
        let shooting = Shooting::new(&harvester, &kernel, 1, 1e-13);
        // From the impact to the next start of the drive.
        let start_s = (exact.angle_rad - angle_rad + PI).rem_euclid(TAU) / 0.8;
        let y = kernel
            .plant
            .from_physical(&reference.start(&exact), start_s);
        let mut integrator = Integrator::new(&kernel, &y, start_s, 1e-13).unwrap();
        integrator.advance_to(TAU / 0.8).unwrap();
        let guess = shooting.unknown(&kernel.plant.to_physical(&integrator.state(), 0.0));
        let position = Position {
            unknown: guess,
            parameter: gap,
        };
        let solution =
            correct_at(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
        let orbit = shooting.orbit(&solution.local, solution.error).unwrap();
        let trace = (orbit.multipliers[0] + orbit.multipliers[1]).re;
        let error = trace / exact.trace_determinant[0] - 1.0;
        eprintln!(
            "1e-{decade}: impact speed {:.3e}, trace {trace:.6e}, off by {error:.1e}",
            exact.speed
        );
        // A position error `d` gives a speed error `a d / v`. Measured: d = 2.4e-15, the roundoff
        // of the two steady amplitudes.
        let roundoff = 4e-15 * 0.64 * amplitude / exact.speed.powi(2);
        assert!(
            orbit.contacts == 1 && error.abs() < 1e-12 + roundoff && !orbit.is_stable(),
            "{error:e}"
        );
        speeds.push((amplitude - gap, exact.speed));
        multipliers.push((amplitude - gap, orbit.floquet_max_abs()));
    }
    let ((speed, _), (multiplier, scatter)) =
        (power_law(&speeds[4..]), power_law(&multipliers[4..]));
    eprintln!(
        "impact speed: exponent {speed:.4}; largest multiplier: {multiplier:.4} (off the line by {scatter:.1e})"
    );
    assert!((speed - 1.0).abs() < 1e-2 && (multiplier + 1.0).abs() < 1e-2);
    // Over the depth that the stop removes, `v^2 / 2 X w^2`, it is the square root again.
    let depths: Vec<_> = speeds
        .iter()
        .zip(&multipliers)
        .map(|((_, v), (_, m))| (v * v / (2.0 * amplitude * 0.64), *m))
        .collect();
    let (exponent, _) = power_law(&depths[4..]);
    assert!((exponent + 0.5).abs() < 5e-3, "{exponent}");
}
