//! Points that are pressed onto a stop, lightly or from the other side, and points that leave it.

use super::several_stops::stop;
use crate::plants::{distance, integrate, kernel, physical, read, springs};
use jounce_model::contact::{ContactLaw, Hertz, KelvinVoigt, Law};

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

/// A table that is pressed against a point of a beam, which rests on a stop and is pushed away from
/// it.
const PUSHED_OFF: &str = r#"
[mass.table]
mass = "2.388 kg"
frequency = "15.95 Hz"
damping_ratio = 0.001
[beam.a]
material = "silicon"
length = "189.5 mm"
width = "38.73 mm"
thickness = "0.2732 mm"
[beam.a.point]
p = "48.97 mm"
[patch.a]
on = "a"
material = "PZT-5H"
start = "82.54 mm"
length = "60.52 mm"
width = "24.74 mm"
thickness = "0.1711 mm"
[circuit.c]
patch = "a"
resistance = "1 Mohm"
[stop.pressed]
at = "table"
frame = "a.p"
law = "kelvin-voigt"
gap = "-0.05071 mm"
stiffness = "8.064e+08 N/m"
damping = "96.8 N s/m"
[stop.left]
at = "a.p"
side = "negative"
law = "hertz"
gap = "0 mm"
stiffness = "1.196e+05 N/m^1.5"
[damping]
beyond = 0.02
[reduction]
modes = 3
"#;

/// A point that rests on a stop leaves it as one that rests just before it. Its displacement begins
/// with the square of the time, and its terms with the time. Each run once ended at its start, because
/// no step was short enough.
#[test]
fn a_point_that_rests_on_a_stop_is_pushed_off_it() {
    let [touching, near] = ["0 mm", "1e-6 mm"].map(|gap| {
        let text = PUSHED_OFF.replace("gap = \"0 mm\"", &format!("gap = \"{gap}\""));
        let kernel = kernel(read(&text));
        let start = vec![0.0; kernel.plant.len()];
        let end = physical(&integrate(&kernel, &start, 0.0, 2e-3, 1e-9), &kernel);
        (kernel, end)
    });
    let apart = distance(&touching.0, &touching.1, &near.1);
    eprintln!("{apart:e}");
    assert!(apart < 1e-9);
}

/// A point moves off a stop that presses it lightly. It gains the energy of the contact, although the
/// first step may be so long that all of its nodes are off the stop.
#[test]
fn a_point_that_moves_off_its_stop_gains_the_energy_of_the_contact() {
    let (depth_m, speed_m_s, end_s) = (1.3e-7, 0.04, 0.05);
    let elastic = Hertz {
        stiffness: 1e8,
        exponent: 1.5,
    };
    let mut system = springs(&[0.0], 0.0);
    let law = Law::Hertz(elastic);
    system.stops.push(stop("floor", &[1.0], -depth_m, law));
    let kernel = kernel(system);
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let end = integrate(&kernel, &[0.0, -speed_m_s], 0.0, end_s, tolerance);
        let exact_m_s = -(speed_m_s.powi(2) + 2.0 * elastic.energy_j(depth_m)).sqrt();
        let error = physical(&end, &kernel)[1] / exact_m_s - 1.0;
        eprintln!("tolerance {tolerance:e}: {error:.1e}, {:?}", end.work());
        assert!(error.abs() < tolerance);
    }
}
