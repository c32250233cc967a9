//! Several events at one instant: switches, impacts on several stops, the end of chatter.

use crate::plants::{from_rest, integrate, kernel, physical, read, relative, springs};
use jounce_dynamics::{IntegrationError, Integrator, Kernel};
use jounce_model::contact::{Law, Rigid};
use jounce_model::plant::{RectifierScheme, Stop};

/// A bimorph under parallel SSHI against a stop, four modes. At 0.1016 s, in contact, the voltage
/// holds the current at zero from either side. Each time the switch inverts it, the current passes
/// zero again at once, until too little voltage is left.
const SWITCHED: &str = r#"
[beam.b]
material = "brass"
length = "60 mm"
width = "15 mm"
thickness = "0.2 mm"
[patch.t]
on = "b"
material = "PZT-5A"
start = "0 mm"
length = "40 mm"
width = "15 mm"
thickness = "0.2 mm"
[patch.u]
on = "b"
face = "bottom"
material = "PZT-5A"
start = "0 mm"
length = "40 mm"
width = "15 mm"
thickness = "0.2 mm"
electrodes = "open"
[mass.tip]
on = "b.end"
mass = "5 g"
[circuit.a]
patch = "t"
interface = "parallel-sshi"
quality_factor = 6
storage = "0.5 uF"
resistance = "200 kohm"
diode_drop = "0.3 V"
[stop.up]
at = "b.end"
law = "hertz"
gap = "0.5 mm"
stiffness = "1e6 N/m^1.5"
[drive.base]
kind = "base-acceleration"
amplitude = "1.0 g"
frequency = "42 Hz"
[damping]
beyond = 0.015
[reduction]
modes = 4
"#;

/// Without a rule for it, steps here shrink to 3e-18 s. Measured: power 1.8e-10 between the
/// tolerances, residuals 9e-11 and 5e-12.
#[test]
fn a_switch_that_closes_repeatedly_at_one_instant_does_not_end_the_run() {
    let kernel = kernel(read(SWITCHED));
    let [coarse, fine] = [1e-7, 1e-9].map(|tolerance| from_rest(&kernel, 0.11, tolerance));
    let residuals = [&coarse, &fine].map(|result| result.energies.residual_relative());
    let change = relative(coarse.mean_power_w, fine.mean_power_w);
    eprintln!(
        "{} contacts, power {:e} W, {change:.1e}, residuals {residuals:?}",
        fine.contacts, fine.mean_power_w
    );
    assert!(
        fine.contacts > 0
            && change < 1e-7
            && residuals.iter().all(|residual| residual.abs() < 1e-9)
    );
}

/// A switch without loss inverts the full voltage, and would close without end there.
#[test]
fn a_switch_that_never_settles_is_an_error() {
    let mut system = read(SWITCHED);
    system.bridges[0].scheme = RectifierScheme::ParallelSshi { inversion: 1.0 };
    let kernel = kernel(system);
    let start = jounce_analysis::run::StartState::rest(&kernel.plant);
    let mut integrator = Integrator::new(
        &kernel,
        &kernel.plant.from_physical(&start.physical(), 0.0),
        0.0,
        1e-7,
    )
    .unwrap();
    let outcome = integrator.advance_to(0.2);
    eprintln!("{outcome:?} at {} s", integrator.time_s());
    assert!(
        matches!(outcome, Err(IntegrationError::ChangesWithoutEnd { circuit, .. }) if circuit == "a")
    );
}

/// A free mass that approaches two others at equal distances.
fn two_stops(masses_kg: [f64; 3], restitution: [f64; 2], order: [usize; 2]) -> Kernel {
    let mut system = springs(&[0.0; 3], 0.0);
    for k in order {
        let mut shape = vec![0.0; 3];
        (shape[0], shape[k]) = (1.0 / masses_kg[0].sqrt(), -1.0 / masses_kg[k].sqrt());
        let law = Law::Rigid(Rigid {
            restitution: restitution[k - 1],
        });
        system.stops.push(Stop {
            name: format!("stop {k}"),
            shape,
            gap_m: 1e-3,
            law,
            bases: Vec::new(),
        });
    }
    kernel(system)
}

/// One mass strikes two others at once. Newton's law for both: with `u_k` the approach speed after
/// the impact, `v - u_k = p_k / m_k + (p_1 + p_2) / m`. In any order of the stops the impulses
/// solve the two equations, measured to 2.3e-16, and equal masses share equally.
#[test]
fn two_rigid_stops_struck_at_once_obey_newtons_law_together() {
    for (masses_kg, restitution) in [
        ([0.01, 0.004, 0.004], [0.8, 0.8]),
        ([0.01, 0.003, 0.005], [0.9, 0.4]),
    ] {
        let [m, a, b] = masses_kg;
        // (1/m + 1/a) p + q / m = 1 + e_1, p / m + (1/m + 1/b) q = 1 + e_2
        let determinant = (1.0 / m + 1.0 / a) * (1.0 / m + 1.0 / b) - 1.0 / (m * m);
        let p = ((1.0 + restitution[0]) * (1.0 / m + 1.0 / b) - (1.0 + restitution[1]) / m)
            / determinant;
        let q = ((1.0 + restitution[1]) * (1.0 / m + 1.0 / a) - (1.0 + restitution[0]) / m)
            / determinant;
        for order in [[1, 2], [2, 1]] {
            let kernel = two_stops(masses_kg, restitution, order);
            let integrator = integrate(
                &kernel,
                &[0.0, 0.0, 0.0, m.sqrt(), 0.0, 0.0],
                0.0,
                2e-3,
                1e-10,
            );
            let state = physical(&integrator, &kernel);
            let speeds: Vec<f64> = (0..3).map(|i| state[3 + i] / masses_kg[i].sqrt()).collect();
            let errors = [
                speeds[0] - (1.0 - (p + q) / m),
                speeds[1] - p / a,
                speeds[2] - q / b,
            ]
            .map(f64::abs);
            let energies = integrator.energies();
            let dissipated_j = 0.5
                * (m - masses_kg
                    .iter()
                    .zip(&speeds)
                    .map(|(m, v)| m * v * v)
                    .sum::<f64>());
            eprintln!(
                "{masses_kg:?} {order:?}: {speeds:?}, errors {errors:?}, lost {dissipated_j:e}"
            );
            assert!(errors.iter().all(|error| *error < 1e-13) && dissipated_j > 0.0);
            assert!(
                relative(energies.contact_loss_j, dissipated_j) < 1e-12
                    && energies.residual_relative().abs() < 1e-13
            );
        }
    }
}

/// Two stops that constrain the same motion share one impulse equally, and the mass rebounds as
/// from one.
#[test]
fn equal_stops_on_one_motion_share_its_impulse() {
    let mut system = springs(&[0.0], 0.0);
    let law = Law::Rigid(Rigid { restitution: 0.6 });
    system.stops = ["one", "other"]
        .map(|name| Stop {
            name: name.into(),
            shape: vec![1.0],
            gap_m: 1e-3,
            law,
            bases: Vec::new(),
        })
        .to_vec();
    let kernel = kernel(system);
    let integrator = integrate(&kernel, &[0.0, 1.0], 0.0, 2e-3, 1e-10);
    let impulses: Vec<f64> = integrator
        .statistics_by_stop()
        .iter()
        .map(|statistics| statistics.impulse_n_s)
        .collect();
    eprintln!("{impulses:?}, {:?}", physical(&integrator, &kernel));
    assert!(
        impulses.iter().all(|impulse| (impulse - 0.8).abs() < 1e-13)
            && (physical(&integrator, &kernel)[1] + 0.6).abs() < 1e-13
    );
}

/// A ball on a table that shakes at 1.2 g: it is thrown, chatters and sticks in every cycle.
/// Measured residuals: at most 1.5e-10 at a tolerance of 1e-7 and 6e-14 at 1e-11. Chatter below the
/// roundoff of the distance would leave 1e-6 at both.
#[test]
fn chatter_that_ends_at_rest_balances_its_energy() {
    for restitution in [0.2, 0.5, 0.8] {
        let mut system = read(
            r#"
            [mass.ball]
            on = "nothing"
            mass = "1 g"
            [stop.t]
            at = "ball"
            side = "negative"
            law = "rigid"
            gap = "0 mm"
            restitution = 0.5
            [gravity]
            acceleration = "-9.81 m/s^2"
            [drive.b]
            kind = "base-acceleration"
            amplitude = "11.772 m/s^2"
            frequency = "10 Hz"
            [reduction]
            modes = 1
            "#,
        );
        system.stops[0].law = Law::Rigid(Rigid { restitution });
        let kernel = kernel(system);
        for tolerance in [1e-7, 1e-11] {
            let integrator = integrate(&kernel, &[0.0, 0.0], 0.0, 1.0, tolerance);
            let (statistics, residual) = (
                integrator.statistics(),
                integrator.energies().residual_relative(),
            );
            eprintln!(
                "e {restitution}, {tolerance:e}: {} contacts, rest {:.4} s, {residual:.1e}",
                statistics.contacts, statistics.sticking_s
            );
            assert!(
                statistics.sticking_s > 0.1 && residual.abs() < (1e-2 * tolerance).max(1e-12),
                "{residual:e}"
            );
        }
    }
}

const BALL_ON_A_TABLE_AT_1_01_G: &str = r#"
[mass.ball]
on = "nothing"
mass = "10 g"
[stop.table]
at = "ball"
side = "negative"
law = "rigid"
gap = "1 mm"
restitution = 0.5
[gravity]
acceleration = "-1 g"
[drive.base]
kind = "base-acceleration"
amplitude = "1.01 g"
frequency = "20 Hz"
[reduction]
modes = 1
"#;

/// A table that shakes at 1.01 g throws its ball a quarter of a micrometre high in every cycle, and
/// the last hops are of the order of roundoff. Sticking erases the past, so every cycle repeats the
/// first one. A ball past its table by more than the height of a hop would sink through it.
#[test]
fn a_ball_does_not_sink_through_its_table() {
    let system = read(BALL_ON_A_TABLE_AT_1_01_G);
    let kernel = kernel(system);
    for tolerance in [1e-8, 1e-10] {
        let mut integrator = Integrator::new(
            &kernel,
            &kernel.plant.from_physical(&[0.0, 0.0], 0.0),
            0.0,
            tolerance,
        )
        .unwrap();
        integrator.advance_to(0.2).unwrap();
        let (mut deepest_m, mut contacts, mut rest_s) = (0.0_f64, Vec::new(), Vec::new());
        for cycle in 4..160 {
            integrator.reset_statistics();
            for part in 1..=5 {
                integrator
                    .advance_to(0.05 * f64::from(cycle) + 0.01 * f64::from(part))
                    .unwrap();
                deepest_m = deepest_m.max(-1e-3 - integrator.physical()[0] / 0.1);
            }
            let statistics = integrator.statistics();
            contacts.push(statistics.contacts);
            rest_s.push(statistics.sticking_s);
        }
        let longest_s = rest_s
            .iter()
            .map(|value| (value - rest_s[0]).abs())
            .fold(0.0, f64::max);
        eprintln!(
            "{tolerance:e}: {} contacts a cycle, deepest {deepest_m:e} m, rest {:e} s, {longest_s:e} s apart",
            contacts[0], rest_s[0]
        );
        assert!(
            deepest_m < 1e-15
                && longest_s < 1e-7
                && contacts.iter().all(|value| value.abs_diff(contacts[0]) < 2),
            "{contacts:?}"
        );
    }
}
