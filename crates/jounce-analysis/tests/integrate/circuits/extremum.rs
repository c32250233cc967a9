//! A switch closes at an extremum of the charge: within roundoff of it, at an impulse, and after a force
//! that jumps.

use super::cell::cell;
use crate::plants::{from_rest, kernel, read};
use crate::runge_kutta::runge_kutta;
use jounce_model::drive::Wave;
use jounce_model::plant::{RectifierScheme, Signal, Storage};

/// A film on a cantilever that rests against a stiff stop. The time of an extremum of its charge has
/// roundoff, so that the current may lie on either side of zero there.
const PRESSED_FILM: &str = r#"
[beam.a]
material = "steel"
length = "164.5 mm"
width = "30.96 mm"
thickness = "0.1897 mm"
[patch.film]
on = "a"
material = "PVDF"
start = "81.42 mm"
length = "61.56 mm"
width = "25.94 mm"
thickness = "0.06273 mm"
[circuit.c]
patch = "film"
interface = "parallel-sshi"
battery = "0.5383 V"
quality_factor = 20
[stop.end]
at = "a.end"
law = "spring"
gap = "0 mm"
stiffness = "3.165e8 N/m"
[drive.base]
kind = "base-displacement"
amplitude = "0.007486 mm"
frequency = "2.446 Hz"
[damping]
beyond = 0.005
[reduction]
modes = 2
"#;

/// Each switch once left the current past the next extremum, by roundoff, and closed without end at
/// 0.83 s.
#[test]
fn a_switch_closes_once_where_roundoff_places_the_current_past_the_next_extremum() {
    let kernel = kernel(read(PRESSED_FILM));
    for tolerance in [1e-6, 1e-7] {
        let energies = from_rest(&kernel, 1.0, tolerance).energies;
        let (switch_j, residual) = (energies.rectified[0].switch_j, energies.residual_relative());
        eprintln!("{switch_j:e} J in the switch, residual {residual:.1e}");
        assert!(switch_j > 0.0 && residual.abs() < tolerance);
    }
}

/// An impulse reverses the current, and at this instant the switch inverts the voltage. The impulse acts
/// once.
#[test]
fn an_impulse_that_closes_a_switch_acts_once() {
    let (theta, zeta, inversion, at_s) = (0.3, 0.02, 0.6, 0.7);
    let scheme = RectifierScheme::ParallelSshi { inversion };
    let mut system = cell(
        theta,
        zeta,
        1.0,
        scheme,
        Storage::Battery { voltage_v: 5.0 },
    );
    system.drives.clear();
    let impulses = [(0.0, 1.0), (at_s, -3.0)];
    system.signals = impulses.map(shock).to_vec();
    let kernel = kernel(system);
    let run = from_rest(&kernel, 1.0, 1e-10);
    let end = run.end.physical();
    let rates = |_, [q, v, volt]: [f64; 3]| [v, theta * volt - q - 2.0 * zeta * v, -theta * v];
    let [q, v, volt] = runge_kutta(rates, [0.0, 1.0, 0.0], at_s, 10_000);
    let plain = runge_kutta(rates, [q, v - 3.0, -inversion * volt], 1.0 - at_s, 10_000);
    eprintln!("{end:?} against {plain:?}");
    assert!((0..3).all(|i| (end[i] - plain[i]).abs() < 1e-9));
    assert!(run.energies.residual_relative().abs() < 1e-12);
}

/// The rate of the current jumps with a force, shortly before an extremum that the force brings
/// forward.
#[test]
fn a_force_that_jumps_moves_the_next_extremum() {
    let (theta, zeta, inversion, at_s, force_n) = (0.3, 0.02, 0.6, 1.4, -3.0);
    let scheme = RectifierScheme::ParallelSshi { inversion };
    let battery = Storage::Battery { voltage_v: 5.0 };
    let mut system = cell(theta, zeta, 1.0, scheme, battery);
    system.drives.clear();
    let force = Wave::Sampled {
        start_s: at_s,
        step_s: 5.0,
        sizes: [force_n, force_n].into(),
    };
    system.signals = vec![shock((0.0, 1.0)), signal("force", force)];
    let end = from_rest(&kernel(system), 2.0, 1e-10).end.physical();
    let under = |force_n: f64| {
        move |_, [q, v, volt]: [f64; 3]| {
            let damped = v * 2.0 * zeta;
            [v, force_n + theta * volt - q - damped, -theta * v]
        }
    };
    let jump = runge_kutta(under(0.0), [0.0, 1.0, 0.0], at_s, 10_000);
    let after = |time_s| runge_kutta(under(force_n), jump, time_s, 2_000);
    let (mut low_s, mut high_s) = (0.0, 0.2);
    for _ in 0..50 {
        let middle_s = 0.5 * (low_s + high_s);
        let rises = after(middle_s)[1] > 0.0;
        *if rises { &mut low_s } else { &mut high_s } = middle_s;
    }
    let [q, v, volt] = after(low_s);
    let rest_s = 2.0 - at_s - low_s;
    let plain = runge_kutta(under(force_n), [q, v, -inversion * volt], rest_s, 10_000);
    eprintln!("{end:?} against {plain:?}, extremum at {} s", at_s + low_s);
    assert!((0..3).all(|i| (end[i] - plain[i]).abs() < 1e-9));
}

fn shock((time_s, size_s): (f64, f64)) -> Signal {
    signal("shock", Wave::Impulse { time_s, size_s })
}

fn signal(name: &str, wave: Wave) -> Signal {
    Signal {
        name: name.to_owned(),
        shape: vec![1.0],
        wave,
        base: None,
        drawn_from: None,
    }
}
