//! A ball on a vibrating table: multipliers and doubling in closed form, with and without gravity.
//!
//! Without gravity a highly stretched spring of stiffness `s` replaces the weight of the ball.
//! Errors are of order `s`; extrapolation to zero from two values of `s` leaves the errors of the
//! method.

use crate::harvesters::Systems;
use jounce_analysis::{Model, Parameter};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_dynamics::Integrator;
use jounce_model::reference::BouncingTable;
use jounce_orbits::{OrbitMethod, ParametricModel, Shooting};
use jounce_spec::{NumericKey, Spec};
use std::f64::consts::{PI, TAU};

const CORRECTOR: Corrector = Corrector {
    goal: 1e-11,
    most: 20,
};

/// Stiffness of the spring that replaces gravity; twice this value gives the order of its error.
const SOFTNESS: f64 = 1e-5;

/// Trace and determinant of the orbit of `cycles`, by shooting over the cycles of the drive.
fn trace_determinant(table: BouncingTable, cycles: u32, softness: f64) -> [f64; 2] {
    let orbit = table.orbit(cycles).unwrap();
    // The drive starts a third of a cycle after the bounce.
    let angle_rad = orbit.angle_rad + TAU / 3.0;
    let harvester = Systems(|ratio| {
        BouncingTable {
            acceleration_ratio: ratio,
            ..table
        }
        .system(softness, angle_rad)
    });
    let kernel = harvester.at(table.acceleration_ratio).unwrap().kernel;
    let start_s = -TAU / 3.0;
    let y = kernel
        .plant
        .from_physical(&table.start(softness, &orbit), start_s);
    let mut integrator = Integrator::new(&kernel, &y, start_s, 1e-12).unwrap();
    integrator.advance_to(0.0).unwrap();
    let shooting = Shooting::new(&harvester, &kernel, cycles, 1e-12);
    let guess = shooting.unknown(&kernel.plant.to_physical(&integrator.state(), 0.0));
    let position = Position {
        unknown: guess,
        parameter: table.acceleration_ratio,
    };
    let solution =
        correct_at(&shooting, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
    let orbit = shooting.orbit(&solution.local, solution.error).unwrap();
    assert_eq!(orbit.contacts, 1);
    let [a, b] = [orbit.multipliers[0], orbit.multipliers[1]];
    [(a + b).re, (a * b).re]
}

/// Extrapolates from two stiffnesses of the spring to zero.
fn without_spring(value: impl Fn(f64) -> f64) -> f64 {
    2.0 * value(SOFTNESS) - value(2.0 * SOFTNESS)
}

#[test]
fn multipliers_are_those_of_the_exact_map() {
    for (restitution, acceleration_ratio, cycles) in
        [(0.5, 1.3, 1), (0.5, 1.6, 1), (0.8, 0.9, 1), (0.8, 1.2, 2)]
    {
        let table = BouncingTable {
            restitution,
            acceleration_ratio,
        };
        let exact = table.orbit(cycles).unwrap().trace_determinant;
        let limit = [0, 1]
            .map(|k| without_spring(|softness| trace_determinant(table, cycles, softness)[k]));
        let plain = trace_determinant(table, cycles, SOFTNESS)[0] - exact[0];
        let errors = [limit[0] - exact[0], limit[1] - exact[1]];
        eprintln!(
            "e {restitution}, G {acceleration_ratio}, {cycles} cycles: {errors:?}, with the spring {plain:.1e}"
        );
        // Measured: 4e-7 at two cycles, where the ball flies four times as high, 3e-8 at one.
        let height = f64::from(cycles * cycles);
        assert!(
            errors.iter().all(|error| error.abs() < 1e-6) && plain.abs() < 50.0 * height * SOFTNESS,
            "{errors:?} {plain:e}"
        );
    }
}

#[test]
fn doubling_is_where_the_closed_form_has_it() {
    for (restitution, exact) in [(0.5, 1.526823701), (0.8, 1.070836468)] {
        let doubling = |softness: f64| {
            let past = |acceleration_ratio: f64| {
                let [trace, determinant] = trace_determinant(
                    BouncingTable {
                        restitution,
                        acceleration_ratio,
                    },
                    1,
                    softness,
                );
                1.0 + trace + determinant
            };
            // Secant method from both sides.
            let (mut a, mut b) = (0.98 * exact, 1.02 * exact);
            let (mut at_a, mut at_b) = (past(a), past(b));
            assert!(at_a > 0.0 && at_b < 0.0);
            for _ in 0..6 {
                let next = b - at_b * (b - a) / (at_b - at_a);
                if (next - b).abs() < 1e-12 {
                    break;
                }
                (a, at_a, b, at_b) = (b, at_b, next, past(next));
            }
            b
        };
        let limit = without_spring(doubling);
        eprintln!(
            "e {restitution}: doubles at {limit:.9}, off by {:.1e}",
            limit - exact
        );
        assert!((limit - exact).abs() < 1e-6, "{limit}");
    }
}

/// The ball under gravity, as in a spec: acceleration of gravity and frequency of the table.
const GRAVITY_M_S2: f64 = 9.81;
const TABLE_HZ: f64 = 10.0;

/// Trace and determinant of the orbit of `cycles` of a free mass under gravity.
fn under_gravity(table: BouncingTable, cycles: u32) -> [f64; 2] {
    let exact = table.orbit(cycles).unwrap();
    let later = TAU / 3.0;
    // The acceleration of a table at `A sin th` is `-w^2 A sin th`.
    let phase_rad = exact.angle_rad + later + PI;
    let text = format!(
        "[mass.ball]\non = \"nothing\"\nmass = \"1 g\"\n[stop.t]\nat = \"ball\"\nside = \"negative\"\nlaw = \"rigid\"\ngap = \"0 mm\"\nrestitution = {}\n\
         [gravity]\nacceleration = \"-{GRAVITY_M_S2} m/s^2\"\n[drive.b]\nkind = \"base-acceleration\"\namplitude = \"{} m/s^2\"\nfrequency = \"{TABLE_HZ} Hz\"\nphase = \"{phase_rad} rad\"\n",
        table.restitution,
        table.acceleration_ratio * GRAVITY_M_S2
    );
    let base = Model::new(Spec::from_toml(&text).unwrap()).unwrap();
    let key = NumericKey::find(&base.spec, "drive.b.amplitude").unwrap();
    let amplitude = key.get(&base.spec).unwrap();
    let harvester = Parameter::new(&base, &key, 1.0);
    // A third of a cycle after the bounce, above the table; lengths in g / w^2, speeds in g / w.
    let (g, w) = (table.acceleration_ratio, TAU * TABLE_HZ);
    let height = exact.speed * later
        - 0.5 * later * later
        - g * ((exact.angle_rad + later).sin() - exact.angle_rad.sin());
    let speed = exact.speed - later - g * (exact.angle_rad + later).cos();
    let shape = base.kernel.plant.system.modes.shape["ball"][0];
    let physical = [
        height * GRAVITY_M_S2 / (w * w) / shape,
        speed * GRAVITY_M_S2 / w / shape,
    ];
    let shooting = Shooting::new(&harvester, &base.kernel, cycles, 1e-12);
    let position = Position {
        unknown: shooting.unknown(&physical),
        parameter: amplitude,
    };
    let metric = Metric::at(&position, 1.0);
    let solution = correct_at(&shooting, &CORRECTOR, &metric, position.clone()).unwrap();
    // The start equals that of the closed form.
    assert!(metric.length(&position.to(&solution.position)) < 1e-9);
    let orbit = shooting.orbit(&solution.local, solution.error).unwrap();
    assert_eq!(orbit.contacts, 1);
    let [a, b] = [orbit.multipliers[0], orbit.multipliers[1]];
    [(a + b).re, (a * b).re]
}

#[test]
fn multipliers_under_gravity_are_those_of_the_exact_map() {
    for (restitution, acceleration_ratio, cycles) in
        [(0.5, 1.3, 1), (0.5, 1.6, 1), (0.8, 0.9, 1), (0.8, 1.2, 2)]
    {
        let table = BouncingTable {
            restitution,
            acceleration_ratio,
        };
        let (exact, computed) = (
            table.orbit(cycles).unwrap().trace_determinant,
            under_gravity(table, cycles),
        );
        let errors = [computed[0] - exact[0], computed[1] - exact[1]];
        eprintln!(
            "e {restitution}, G {acceleration_ratio}, {cycles} cycles under gravity: {errors:?}"
        );
        assert!(errors.iter().all(|error| error.abs() < 1e-9), "{errors:?}");
    }
}

#[test]
fn doubling_under_gravity_is_where_the_closed_form_has_it() {
    for (restitution, exact) in [(0.5, 1.526823701), (0.8, 1.070836468)] {
        let past = |acceleration_ratio: f64| {
            let [trace, determinant] = under_gravity(
                BouncingTable {
                    restitution,
                    acceleration_ratio,
                },
                1,
            );
            1.0 + trace + determinant
        };
        let (below, above) = (past(exact - 1e-8), past(exact + 1e-8));
        assert!(below > 0.0 && above < 0.0, "{below:e} {above:e}");
    }
}
