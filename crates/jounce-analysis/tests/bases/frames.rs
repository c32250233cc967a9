//! A mass on a spring on a moving base strikes stops at rest. In the frame of the base, inertial
//! forces act and the stops move. In space, a force `k X + c X'` acts, the stops are at rest, and
//! there is no base. Both must give one motion.

use crate::systems::{LAWS, integrator, kernel, motion};
use std::f64::consts::{PI, TAU};

const MASS_KG: f64 = 1.0;
const FREQUENCY_HZ: f64 = 6.0;
const TOLERANCE: f64 = 1e-12;

fn stiffness_n_m() -> f64 {
    MASS_KG * (TAU * FREQUENCY_HZ).powi(2)
}

/// A mass on a base, with two stops fixed to the ground.
fn text(on: &str, damping_ratio: f64, law: &str, drives: &str) -> String {
    let stop = |name: &str, side: &str, gap: &str| {
        format!(
            "[stop.{name}]\nat = \"mass\"\nframe = \"ground\"\nside = \"{side}\"\ngap = \"{gap}\"\n{law}\n"
        )
    };
    format!(
        "[mass.mass]\non = \"{on}\"\nmass = \"1 kg\"\nfrequency = \"{FREQUENCY_HZ} Hz\"\ndamping_ratio = {damping_ratio}\n{}{}{drives}",
        stop("above", "positive", "1 mm"),
        stop("below", "negative", "1.7 mm"),
    )
}

/// Integrates both to several times and compares position and speed in space; returns the number of
/// contacts.
fn compare(
    name: &str,
    moving: &str,
    fixed: &str,
    base: impl Fn(f64) -> [f64; 2],
    allowed: f64,
) -> u64 {
    let (moving, fixed) = (kernel(moving), kernel(fixed));
    let [x, v] = base(0.0);
    // At rest in space, for both.
    let mut one = integrator(&moving, &[-x], &[-v], TOLERANCE);
    let mut other = integrator(&fixed, &[0.0], &[0.0], TOLERANCE);
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for k in 1..=40 {
        let time_s = 0.0371 * f64::from(k);
        one.advance_to(time_s).unwrap();
        other.advance_to(time_s).unwrap();
        let ([position, speed], [fixed_m, fixed_m_s]) = (
            motion(&one, &moving, "mass"),
            motion(&other, &fixed, "mass"),
        );
        let [x, v] = base(time_s);
        let rate = TAU * FREQUENCY_HZ;
        worst = worst.max(
            (position + x - fixed_m)
                .abs()
                .max((speed + v - fixed_m_s).abs() / rate),
        );
        largest = largest.max(fixed_m.abs());
    }
    let (contacts, balance) = (
        one.statistics().contacts,
        one.energies().residual_relative().abs(),
    );
    eprintln!(
        "{name}: {contacts} contacts, apart by {:.1e}, balance {balance:.1e}",
        worst / largest
    );
    assert_eq!(contacts, other.statistics().contacts, "{name}");
    assert!(
        worst < allowed * largest && balance < 1e-10,
        "{name}: {:e}, {balance:e}",
        worst / largest
    );
    contacts
}

/// Sinusoidal displacement and acceleration, against two forces of one frequency.
#[test]
fn a_sinusoidal_base_is_a_force_on_its_spring() {
    let (amplitude_m, drive_hz, phase, ratio): (f64, f64, f64, f64) = (0.9e-3, 7.3, 0.4, 0.03);
    let w = TAU * drive_hz;
    let c = 2.0 * ratio * TAU * FREQUENCY_HZ * MASS_KG;
    let (size, turn) = (
        amplitude_m * stiffness_n_m().hypot(c * w),
        phase + (c * w).atan2(stiffness_n_m()),
    );
    let course = |amplitude: String, kind: &str, angle: f64| {
        format!(
            "[drive.d]\n{kind}amplitude = \"{amplitude}\"\nfrequency = \"{drive_hz} Hz\"\nphase = \"{angle:.17} rad\"\n"
        )
    };
    let with_displacement = course(
        format!("{amplitude_m:.17e} m"),
        "kind = \"base-displacement\"\nat = \"head\"\n",
        phase,
    );
    let peak_m_s2 = amplitude_m * w * w;
    let with_acceleration = course(
        format!("{peak_m_s2:.17e} m/s^2"),
        "kind = \"base-acceleration\"\nat = \"head\"\n",
        phase + PI,
    );
    let with_force = course(format!("{size:.17e} N"), "at = \"mass\"\n", turn);
    let base = |t: f64| {
        [
            amplitude_m * (w * t + phase).sin(),
            amplitude_m * w * (w * t + phase).cos(),
        ]
    };
    for law in LAWS {
        for (kind, drive) in [
            ("displacement", &with_displacement),
            ("acceleration", &with_acceleration),
        ] {
            let contacts = compare(
                &format!("{kind}, {}", law.lines().next().unwrap()),
                &text("head", ratio, law, drive),
                &text("ground", ratio, law, &with_force),
                base,
                1e-10,
            );
            assert!(contacts > 5);
        }
    }
}

/// A half-sine of displacement and a chirp: without damping the force is the same signal times `k`.
#[test]
fn other_displacements_are_forces_on_a_spring_too() {
    let k = stiffness_n_m();
    let (amplitude_m, start_s, duration_s) = (4e-3, 0.05, 0.11);
    let course = |amplitude: String, at: &str, rest: &str| {
        format!("[drive.d]\n{at}amplitude = \"{amplitude}\"\n{rest}")
    };
    let head = "kind = \"base-displacement\"\nat = \"head\"\n";
    let pulse =
        format!("signal = \"half-sine\"\nstart = \"{start_s} s\"\nduration = \"{duration_s} s\"\n");
    let on_pulse = |t: f64| (start_s..start_s + duration_s).contains(&t);
    let half = |t: f64| {
        let (sin, cos) = (PI * (t - start_s) / duration_s).sin_cos();
        if on_pulse(t) {
            [amplitude_m * sin, amplitude_m * PI / duration_s * cos]
        } else {
            [0.0; 2]
        }
    };
    let sweep = "signal = \"chirp\"\nfrom = \"4 Hz\"\nto = \"12 Hz\"\nduration = \"3 s\"\n";
    let chirp = |t: f64| {
        // The jump of its velocity at the start is still ahead.
        if t == 0.0 {
            return [0.0; 2];
        }
        let (angle, rate) = (
            TAU * (4.0 * t + 8.0 / 6.0 * t * t),
            TAU * (4.0 + 8.0 / 3.0 * t),
        );
        let (sin, cos) = angle.sin_cos();
        [1.1e-3 * sin, 1.1e-3 * rate * cos]
    };
    for law in LAWS {
        let name = law.lines().next().unwrap();
        let moving = text(
            "head",
            0.0,
            law,
            &course(format!("{amplitude_m:.17e} m"), head, &pulse),
        );
        let fixed = text(
            "ground",
            0.0,
            law,
            &course(
                format!("{:.17e} N", k * amplitude_m),
                "at = \"mass\"\n",
                &pulse,
            ),
        );
        assert!(compare(&format!("half-sine, {name}"), &moving, &fixed, half, 1e-9) >= 3);
        let moving = text("head", 0.0, law, &course("1.1 mm".to_owned(), head, sweep));
        let fixed = text(
            "ground",
            0.0,
            law,
            &course(format!("{:.17e} N", k * 1.1e-3), "at = \"mass\"\n", sweep),
        );
        assert!(compare(&format!("chirp, {name}"), &moving, &fixed, chirp, 1e-6) >= 3);
    }
}
