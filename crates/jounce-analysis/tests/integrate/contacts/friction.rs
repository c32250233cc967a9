//! A free mass in a channel with viscous friction, from its spec, against closed forms: rate
//! `a = c / m`.

use crate::plants::{integrate, kernel, physical, relative};
use jounce_dynamics::Kernel;
use jounce_model::plant::System;
use jounce_model::structure::modes;
use jounce_spec::Spec;

const MASS_KG: f64 = 4e-3;
const FRICTION_N_S_M: f64 = 0.02;
const RATE_PER_S: f64 = FRICTION_N_S_M / MASS_KG;
const G_M_S2: f64 = 9.81;

const MISSILE: &str =
    "[mass.missile]\non = \"nothing\"\nmass = \"4 g\"\nfriction = \"0.02 N s/m\"\n";
const GRAVITY: &str = "[gravity]\nacceleration = \"9.81 m/s^2\"\n";
const WALL: &str =
    "[stop.wall]\nat = \"missile\"\nlaw = \"rigid\"\ngap = \"25 mm\"\nrestitution = 0.7\n";

fn channel(more: &str) -> Kernel {
    let spec =
        Spec::from_toml(&format!("{MISSILE}{more}")).unwrap_or_else(|faults| panic!("{faults}"));
    kernel(System::assemble(&spec, modes(&spec).unwrap()).unwrap())
}

/// `(q, q')` for a velocity, m/s.
fn start(velocity_m_s: f64) -> Vec<f64> {
    vec![0.0, MASS_KG.sqrt() * velocity_m_s]
}

/// Displacement, m, and velocity, m/s.
fn motion(state: &[f64]) -> [f64; 2] {
    [state[0], state[1]].map(|q| q / MASS_KG.sqrt())
}

/// Released under gravity: `v = g / a (1 - e^(-a t))`, in the limit `m g / c`. The work of gravity
/// is the friction loss plus the kinetic energy. Measured: 4e-14, the loss 1.5e-12 (of the fall of
/// 0.5 mm within 10 ms; 1e-15 later).
#[test]
fn a_falling_mass_reaches_its_last_speed() {
    let kernel = channel(&format!("{GRAVITY}{WALL}").replace("25 mm", "100 m"));
    for time_s in [0.01, 0.3, 10.0] {
        let integrator = integrate(&kernel, &start(0.0), 0.0, time_s, 1e-10);
        let [x, v] = motion(&physical(&integrator, &kernel));
        let (last_m_s, decay) = (
            MASS_KG * G_M_S2 / FRICTION_N_S_M,
            (-RATE_PER_S * time_s).exp(),
        );
        let (exact_m_s, exact_m) = (
            last_m_s * (1.0 - decay),
            last_m_s * (time_s - (1.0 - decay) / RATE_PER_S),
        );
        let energies = integrator.energies();
        let dissipated_j = MASS_KG * G_M_S2 * exact_m - 0.5 * MASS_KG * exact_m_s * exact_m_s;
        let errors = [
            relative(v, exact_m_s),
            relative(x, exact_m),
            relative(energies.damping_j, dissipated_j),
            energies.residual_relative(),
        ];
        eprintln!("{time_s} s: {v} of {last_m_s} m/s, errors {errors:?}");
        assert!(errors.iter().all(|error| error.abs() < 1e-11), "{errors:?}");
        assert!(time_s < 10.0 || relative(v, last_m_s) < 1e-12);
    }
}

/// Thrown at a rigid wall 25 mm away: it arrives at `-ln(1 - a d / v) / a` with `v - a d`, and
/// rebounds with 0.7 of it. At too low a speed it never arrives: its total travel is `v / a`.
/// Measured: 2e-15.
#[test]
fn a_thrown_mass_strikes_with_the_speed_after_friction() {
    let kernel = channel(WALL);
    let (gap_m, speed_m_s) = (0.025, 0.8);
    let impact_s = -(1.0 - RATE_PER_S * gap_m / speed_m_s).ln() / RATE_PER_S;
    let before = integrate(
        &kernel,
        &start(speed_m_s),
        0.0,
        impact_s * (1.0 - 1e-9),
        1e-10,
    );
    assert_eq!(before.statistics().contacts, 0);
    let after_s = 0.05;
    let after = integrate(&kernel, &start(speed_m_s), 0.0, impact_s + after_s, 1e-10);
    let impact_m_s = speed_m_s - RATE_PER_S * gap_m;
    let [x, v] = motion(&physical(&after, &kernel));
    let decay = (-RATE_PER_S * after_s).exp();
    let errors = [
        relative(after.statistics().max_impact_velocity_m_s, impact_m_s),
        relative(v, -0.7 * impact_m_s * decay),
        relative(gap_m - x, 0.7 * impact_m_s * (1.0 - decay) / RATE_PER_S),
        after.energies().residual_relative(),
    ];
    eprintln!("{errors:?}");
    assert!(
        after.statistics().contacts == 1 && errors.iter().all(|error| error.abs() < 1e-11),
        "{errors:?}"
    );
    let slow_m_s = RATE_PER_S * gap_m * (1.0 - 1e-9);
    let short = integrate(&kernel, &start(slow_m_s), 0.0, 100.0, 1e-10);
    assert!(
        short.statistics().contacts == 0
            && relative(motion(&physical(&short, &kernel))[0], slow_m_s / RATE_PER_S) < 1e-11
    );
}

/// A frame oscillates with amplitude `X`; the missile moves relative to it with amplitude
/// `X w / sqrt(w^2 + a^2)`. Measured: 2e-15.
#[test]
fn a_shaken_channel_drags_its_missile() {
    let drive = "[drive.frame]\nkind = \"base-displacement\"\namplitude = \"10 mm\"\nfrequency = \"2 Hz\"\n";
    let kernel = channel(&format!("{drive}{WALL}").replace("25 mm", "1 m"));
    let w = std::f64::consts::TAU * 2.0;
    let amplitude_m = 0.01 * w / w.hypot(RATE_PER_S);
    // After 20 s only the mean position depends on the start; half the difference of the two
    // extremes is the amplitude.
    let at = |time_s: f64| {
        motion(&physical(
            &integrate(&kernel, &start(0.0), 0.0, time_s, 1e-10),
            &kernel,
        ))
    };
    let [quarter, now] = [at(20.0 + 0.125), at(20.0)];
    let amplitude_m_s = now[1].hypot(quarter[1]);
    eprintln!("{:.1e}", relative(amplitude_m_s, w * amplitude_m));
    assert!(relative(amplitude_m_s, w * amplitude_m) < 1e-10);
}

#[test]
fn friction_that_does_not_fit_is_refused() {
    let sprung = "[mass.m]\nmass = \"1 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.1\nfriction = \"1 N s/m\"\n";
    let carrying = format!(
        "{MISSILE}{GRAVITY}[mass.rider]\non = \"missile\"\nmass = \"1 g\"\nfrequency = \"9 Hz\"\ndamping_ratio = 0.1\n"
    );
    let fixed = format!(
        "{MISSILE}{GRAVITY}[mass.rider]\non = \"missile\"\nmass = \"1 g\"\nfriction = \"1 N s/m\"\n"
    );
    for (text, message) in [
        (
            sprung.to_owned(),
            "mass.m.friction does not apply to a mass on a spring, whose loss is set by `damping_ratio`",
        ),
        (
            carrying,
            "mass.missile.friction does not apply to a mass that carries a moving element, here mass.rider",
        ),
        (
            fixed,
            "mass.rider.friction is for a free mass that moves in a channel; set on = \"nothing\"",
        ),
        (
            format!("{}{GRAVITY}", MISSILE.replace("0.02", "-1")),
            "mass.missile.friction is -1 N s/m; it must be at least 0",
        ),
    ] {
        let faults = Spec::from_toml(&text).unwrap_err().to_string();
        assert!(
            faults.contains(message) && faults.lines().count() == 1,
            "{text}\n-> {faults}"
        );
    }
}
