//! Rigid stops: periodic impacts and chatter against their closed forms.

use crate::plants::{distance, integrate, kernel, physical, relative};
use jounce_dynamics::Integrator;
use jounce_model::reference::{BouncingBall, ImpactOscillator, Reference};
use std::f64::consts::TAU;

#[test]
fn orbit_with_one_impact_per_cycle_repeats_itself() {
    for (frequency_ratio, damping_ratio, gap) in [(2.0, 0.0, 0.0), (0.8, 0.05, 0.5)] {
        let problem = ImpactOscillator {
            frequency_ratio,
            damping_ratio,
            restitution: 0.8,
            gap,
        };
        let orbit = problem.orbits(1)[0];
        let system = problem.system(orbit.angle_rad);
        let kernel = kernel(system);
        let period_s = TAU / frequency_ratio;
        let y = kernel.plant.from_physical(&problem.start(&orbit), 0.0);
        let mut integrator = Integrator::new(&kernel, &y, 0.0, 1e-10).unwrap();
        integrator.advance_to(0.5 * period_s).unwrap();
        let first = physical(&integrator, &kernel);
        integrator.advance_to(50.5 * period_s).unwrap();
        let drift = distance(&kernel, &physical(&integrator, &kernel), &first);
        let loss_j = integrator.energies().contact_loss_j;
        let exact = 50.0 * 0.5 * (1.0 - 0.8 * 0.8) * orbit.speed.powi(2);
        eprintln!(
            "w {frequency_ratio}: drift {drift:.1e}, loss {:.1e}, energy {:.1e}",
            relative(loss_j, exact),
            integrator.energies().residual_relative()
        );
        assert_eq!(integrator.statistics().contacts, 50);
        assert!(
            drift < ImpactOscillator::TOLERANCE
                && relative(loss_j, exact) < ImpactOscillator::TOLERANCE,
            "{drift:e}"
        );
        assert!(integrator.energies().residual_relative().abs() < 1e-10);
    }
}

/// A spring stretched by 1 m at the stop has an almost constant force over bounces of a micrometre:
/// a ball under gravity.
#[test]
fn chatter_ends_when_the_bouncing_ball_rests() {
    let ball = BouncingBall {
        height_m: 1e-6,
        gravity_m_s2: 1.0,
        restitution: 0.8,
    };
    let mut system = ImpactOscillator {
        frequency_ratio: 1.0,
        damping_ratio: 0.0,
        restitution: 0.8,
        gap: -1.0,
    }
    .system(0.0);
    system.drives.clear();
    let kernel = kernel(system);
    let end_s = 2.0 * ball.time_to_rest_s();
    let integrator = integrate(&kernel, &[-1.0 - ball.height_m, 0.0], 0.0, end_s, 1e-10);
    let rest_s = end_s - integrator.statistics().sticking_s;
    let error = relative(rest_s, ball.time_to_rest_s());
    let loss_error = relative(integrator.energies().contact_loss_j, ball.height_m);
    eprintln!(
        "rest after {rest_s} s: {error:.1e}, loss {loss_error:.1e}, {} contacts",
        integrator.statistics().contacts
    );
    // The spring force grows by a millionth with height.
    assert!(
        error < 1e-5 && loss_error < 1e-5,
        "{rest_s} {error:e} {loss_error:e}"
    );
    assert!((physical(&integrator, &kernel)[0] + 1.0).abs() < 1e-14);
}
