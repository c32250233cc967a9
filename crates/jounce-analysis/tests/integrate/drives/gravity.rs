//! Gravity: a ball that bounces, falls and returns, and the sag of a mass on a spring.

use super::oscillator::{oscillator, spring_mass, with_signal, with_stop};
use crate::plants::{kernel, physical, relative};
use jounce_dynamics::Integrator;
use jounce_model::contact::{Hertz, Law, Rigid};
use jounce_model::drive::Wave;
use jounce_model::reference::BouncingBall;

/// Measured: speeds after each of eight bounces and the time to rest to 3e-13, energy residual
/// 1e-15.
#[test]
fn a_ball_bounces_under_gravity_as_in_its_closed_form() {
    let ball = BouncingBall {
        height_m: 0.7,
        gravity_m_s2: 9.81,
        restitution: 0.8,
    };
    let system = with_signal(oscillator(0.0, 0.0), Wave::Constant(ball.gravity_m_s2));
    let kernel = kernel(with_stop(
        system,
        0.0,
        Law::Rigid(Rigid {
            restitution: ball.restitution,
        }),
    ));
    let start = kernel.plant.from_physical(&[-ball.height_m, 0.0], 0.0);
    let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-12).unwrap();
    let mut worst = 0.0_f64;
    for bounce in 0..8 {
        let top_s = 0.5 * (ball.bounce_s(bounce) + ball.bounce_s(bounce + 1));
        integrator.advance_to(top_s).unwrap();
        let state = physical(&integrator, &kernel);
        let height_m = 0.5 * ball.speed_after_m_s(bounce).powi(2) / ball.gravity_m_s2;
        worst = worst
            .max(relative(-state[0], height_m))
            .max(state[1].abs() / ball.speed_after_m_s(bounce));
        assert_eq!(integrator.statistics().contacts, u64::from(bounce) + 1);
    }
    let end_s = ball.time_to_rest_s() + 1.0;
    integrator.advance_to(end_s).unwrap();
    let rest = relative(
        end_s - integrator.statistics().sticking_s,
        ball.time_to_rest_s(),
    );
    let residual = integrator.energies().residual_relative();
    eprintln!("tops {worst:.1e}, time to rest {rest:.1e}, energy {residual:.1e}");
    assert!(
        worst < 1e-10 && rest < 1e-9 && residual.abs() < 1e-11,
        "{worst:e} {rest:e} {residual:e}"
    );
    assert_eq!(physical(&integrator, &kernel), [0.0, 0.0]);
}

/// The deepest point solves `m g (h + d) = k d^(5/2) / (5/2)`, and the ball returns to its initial
/// height.
#[test]
fn a_ball_falls_onto_a_hertz_stop_and_comes_back() {
    let (height_m, gravity, stiffness) = (0.2, 9.81, 1e6);
    let system = with_signal(oscillator(0.0, 0.0), Wave::Constant(gravity));
    let kernel = kernel(with_stop(
        system,
        0.0,
        Law::Hertz(Hertz {
            stiffness,
            exponent: 1.5,
        }),
    ));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let d = 0.5 * (low + high);
        if gravity * (height_m + d) > stiffness * d.powf(2.5) / 2.5 {
            low = d
        } else {
            high = d
        }
    }
    let start = kernel.plant.from_physical(&[-height_m, 0.0], 0.0);
    let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-11).unwrap();
    let fall_s = (2.0 * height_m / gravity).sqrt();
    // At 2.3 fall times after the start the ball moves up.
    integrator.advance_to(2.3 * fall_s).unwrap();
    let state = physical(&integrator, &kernel);
    let energy = relative(
        0.5 * state[1] * state[1] - gravity * state[0],
        gravity * height_m,
    );
    let depth = relative(integrator.statistics().max_penetration_m, low);
    let residual = integrator.energies().residual_relative();
    eprintln!("depth {depth:.1e}, height {energy:.1e}, energy {residual:.1e}");
    assert!(
        integrator.statistics().contacts == 1
            && depth < 1e-9
            && energy < 1e-9
            && residual.abs() < 1e-9,
        "{depth:e} {energy:e}"
    );
}

#[test]
fn gravity_lets_a_sprung_mass_sag() {
    let system = with_signal(oscillator(30.0, 0.1), Wave::Constant(-9.81));
    let kernel = kernel(system);
    let sag_m = -9.81 / 900.0;
    let plan = jounce_analysis::run::RunPlan {
        duration_s: 20.0,
        average_over_s: 1.0,
        tolerance: 1e-10,
        record_s: 0.0,
    };
    let rest = jounce_analysis::run::StartState::rest(&kernel.plant);
    let settled = jounce_analysis::run::simulate(&kernel, &rest, &plan).unwrap();
    let linear = jounce_analysis::run::StartState::linear(&kernel.plant);
    assert!(
        relative(settled.end.displacement[0], sag_m) < 1e-13
            && relative(linear.displacement[0], sag_m) < 1e-15
    );
    assert!(settled.energies.residual_relative().abs() < 1e-13 && settled.settlement.is_none());
}

#[test]
fn gravity_of_a_spec_acts_on_its_masses() {
    let system = spring_mass("[gravity]\nacceleration = \"-9.81 m/s^2\"");
    let kernel = kernel(system);
    let linear = jounce_analysis::run::StartState::linear(&kernel.plant);
    let shape = kernel.plant.system.modes.shape["m"][0];
    assert!(relative(shape * linear.displacement[0], -9.81 / 3600.0) < 1e-14);
}
