//! A mass pressed lightly onto a very stiff stop: its penetration is near the roundoff of its
//! displacement.

use super::several_stops::stop;
use crate::plants::{integrate, kernel, physical, springs};
use jounce_model::contact::{KelvinVoigt, Law};

const FREQUENCY_HZ: f64 = 0.5;
const STIFFNESS_N_M: f64 = 6e9;
const GAP_M: f64 = -1e-3;
const END_S: f64 = 2e-3;

/// From rest on the surface, the penetration is `d (1 - cos(W t))` with the static one `d`: it
/// returns to the surface, at rest, in every period.
#[test]
fn a_light_press_takes_no_more_steps_than_its_oscillation() {
    let k = (std::f64::consts::TAU * FREQUENCY_HZ).powi(2);
    let mut system = springs(&[FREQUENCY_HZ], 0.0);
    system.stops.push(stop(
        "floor",
        &[1.0],
        GAP_M,
        Law::KelvinVoigt(KelvinVoigt {
            stiffness_n_m: STIFFNESS_N_M,
            damping_n_s_m: 0.0,
        }),
    ));
    let kernel = kernel(system);
    let integrator = integrate(&kernel, &[GAP_M, 0.0], 0.0, END_S, 1e-7);
    let static_m = -k * GAP_M / (k + STIFFNESS_N_M);
    let turn_rad_s = (k + STIFFNESS_N_M).sqrt();
    let exact_m = static_m * (1.0 - (turn_rad_s * END_S).cos());
    let penetration_m = physical(&integrator, &kernel)[0] - GAP_M;
    let error = (penetration_m - exact_m).abs() / static_m;
    let work = integrator.work();
    let periods = turn_rad_s * END_S / std::f64::consts::TAU;
    eprintln!("error {error:e}, {periods} periods, {work:?}");
    assert!(error < 1e-4, "{penetration_m:e} {exact_m:e}");
    assert!((work.contact_steps as f64) < 12.0 * periods, "{work:?}");
}
