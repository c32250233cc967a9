//! Brute force against closed forms: linear harvester, one collision per law, impact oscillator of
//! Shaw and Holmes.

use crate::brute::{Flow, Kind, Patience, ReferenceModel, classify};
use jounce_analysis::Model;
use jounce_model::plant::System;
use jounce_model::reference::ImpactOscillator;
use jounce_spec::SpecFile;
use std::f64::consts::{PI, TAU};

const TOLERANCE: f64 = 1e-12;

fn system(text: &str) -> System {
    Model::new(SpecFile::from_text(text).spec().unwrap())
        .unwrap()
        .kernel
        .plant
        .system
        .clone()
}

/// `|V|^2 / (2 R)` with `(-W^2 + 2 i zeta w W + w^2) q = theta V + p`,
/// `(i W C + 1 / R) V = -i W theta q`, eliminated by hand.
#[test]
fn without_contact_the_power_is_that_of_the_linear_harvester() {
    let (w, zeta, drive, theta, capacitance, resistance, force): (
        f64,
        f64,
        f64,
        f64,
        f64,
        f64,
        f64,
    ) = (TAU * 3.0, 0.02, TAU * 3.1, 0.004, 1e-6, 3e4, 0.2);
    let text = "[modal.h]\nfrequency_hz = [3.0]\ndamping_ratio = [0.02]\n[modal.h.point]\ntip = [1.0]\n\
        [modal.h.patch.p]\ncoupling_n_per_v = [0.004]\ncapacitance = \"1 uF\"\n[circuit.c]\npatch = \"h.p\"\nresistance = \"30 kohm\"\n\
        [drive.d]\nat = \"h.tip\"\namplitude = \"0.2 N\"\nfrequency = \"3.1 Hz\"\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    let system = system(text);
    let model = ReferenceModel::<1, 4>::of(&system);
    let ending = classify(
        Flow {
            model: &model,
            tolerance: TOLERANCE,
            has_series: true,
        },
        &[0.0, 0.0, 0.0],
        Patience {
            cycles: 4000,
            period: 64,
        },
    );
    // theta V = -(real + i imaginary) q
    let (admittance_re, admittance_im) = (resistance.recip(), drive * capacitance);
    let square = admittance_re * admittance_re + admittance_im * admittance_im;
    let (added_re, added_im) = (
        theta * theta * drive * admittance_im / square,
        theta * theta * drive * admittance_re / square,
    );
    let dynamic = (w * w - drive * drive + added_re).hypot(2.0 * zeta * w * drive + added_im);
    let voltage = drive * theta * (force / dynamic) / square.sqrt();
    let power = voltage * voltage / (2.0 * resistance);
    assert_eq!(ending.kind, Kind::Periodic(1));
    eprintln!(
        "{} W, closed form {power} W, {} cycles",
        ending.mean_power_w, ending.cycles
    );
    assert!(
        (ending.mean_power_w / power - 1.0).abs() < 1e-8,
        "{} {power}",
        ending.mean_power_w
    );
}

/// Position and speed of a free mass of 1 kg, one second after it starts 0.1 m before the stop at
/// 0.5 m/s.
fn after_collision(law: &str) -> [f64; 2] {
    let text = format!(
        "[modal.h]\nfrequency_hz = [0.0]\ndamping_ratio = [0.0]\n[modal.h.point]\ntip = [1.0]\n\
         [stop.s]\nat = \"h.tip\"\ngap = \"0.1 m\"\n{law}\n\
         [drive.d]\nat = \"h.tip\"\namplitude = \"0 N\"\nfrequency = \"1 Hz\"\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n"
    );
    let system = system(&text);
    let model = ReferenceModel::<1, 4>::of(&system);
    let flow = Flow {
        model: &model,
        tolerance: TOLERANCE,
        has_series: true,
    };
    let mut motion = flow.start(model.state(&[0.0, 0.5]));
    flow.cycle(&mut motion);
    [motion.state[0], motion.state[1]]
}

/// An elastic law: the speed is reversed, and the duration of contact is
/// `2 (d / v) sqrt(pi) G(1 + 1/(n+1)) / G(1/2 + 1/(n+1))`, `d^(n+1) = (n + 1) m v^2 / (2 k)`.
#[test]
fn elastic_collisions_take_the_time_of_hertz() {
    for (law, n, k) in [
        ("law = \"hertz\"\nstiffness = \"1000 N/m^1.5\"", 1.5, 1e3),
        (
            "law = \"hertz\"\nstiffness = \"100 N/m^1.2\"\nexponent = 1.2",
            1.2,
            1e2,
        ),
        ("law = \"spring\"\nstiffness = \"400 N/m\"", 1.0, 400.0),
    ] {
        let v: f64 = 0.5;
        let depth = ((n + 1.0) * v * v / (2.0 * k)).powf(1.0 / (n + 1.0));
        let part = 1.0 / (n + 1.0);
        let duration =
            2.0 * depth / v * PI.sqrt() * libm::tgamma(1.0 + part) / libm::tgamma(0.5 + part);
        let [position, speed] = after_collision(law);
        let expected = 0.1 - v * (1.0 - 0.2 - duration);
        eprintln!("{law}: speed {speed}, place {position} {expected}");
        assert!(
            (speed + v).abs() < 1e-11 && (position - expected).abs() < 1e-11,
            "{law}: {position} {speed}, {expected}"
        );
    }
}

/// `m v dv / (1 + a v) = -k d^n dd`, from and to `d = 0`: `v - ln(1 + a v) / a` is equal before and
/// after.
#[test]
fn a_collision_of_hunt_and_crossley_keeps_its_first_integral() {
    let a: f64 = 0.7;
    let [_, after] = after_collision(
        "law = \"hunt-crossley\"\nstiffness = \"1000 N/m^1.5\"\ndamping = \"0.7 s/m\"",
    );
    let integral = |v: f64| v - (1.0 + a * v).ln() / a;
    eprintln!("{after}");
    assert!(
        after < -0.3 && (integral(0.5) - integral(after)).abs() < 1e-12,
        "{after}"
    );
}

/// Damped oscillator until its force vanishes at the angle `pi - 2 asin zeta`.
#[test]
fn a_collision_of_kelvin_and_voigt_ends_where_its_force_vanishes() {
    let (k, zeta): (f64, f64) = (400.0, 0.2);
    let damping = 2.0 * zeta * k.sqrt();
    let [_, after] = after_collision(&format!(
        "law = \"kelvin-voigt\"\nstiffness = \"400 N/m\"\ndamping = \"{damping} N s/m\""
    ));
    let (angle, root) = (PI - 2.0 * zeta.asin(), (1.0 - zeta * zeta).sqrt());
    let expected = 0.5 * (-zeta / root * angle).exp() * (angle.cos() - zeta / root * angle.sin());
    assert!((after - expected).abs() < 1e-12, "{after} {expected}");
}

#[test]
fn a_rigid_collision_keeps_the_restitution() {
    let [position, speed] = after_collision("law = \"rigid\"\nrestitution = 0.6");
    assert!(
        (speed + 0.3).abs() < 1e-14 && (position - (0.1 - 0.8 * 0.3)).abs() < 1e-13,
        "{position} {speed}"
    );
}

/// A stable orbit with an impact at the start of each drive cycle: the state there is that just
/// before or just after the impact.
#[test]
fn the_impact_oscillator_stays_on_its_closed_form() {
    let oscillator = ImpactOscillator {
        frequency_ratio: 2.0,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap: 0.1,
    };
    let orbit = oscillator
        .orbits(1)
        .into_iter()
        .find(|orbit| orbit.is_stable())
        .unwrap();
    let model = ReferenceModel::<1, 4>::of(&oscillator.system(orbit.angle_rad));
    let flow = Flow {
        model: &model,
        tolerance: TOLERANCE,
        has_series: true,
    };
    let mut motion = flow.start(model.state(&oscillator.start(&orbit)));
    for cycle in 1..=50 {
        flow.cycle(&mut motion);
        let [position, speed] = [motion.state[0], motion.state[1]];
        let error = (speed - orbit.speed)
            .abs()
            .min((speed + 0.8 * orbit.speed).abs());
        assert!(
            (position - 0.1).abs() < 1e-10 && error < 1e-10,
            "cycle {cycle}: {position} {speed}, {orbit:?}"
        );
    }
}

/// At 2.8 times its frequency, on a stop without gap, the oscillator is chaotic (the exponent in
/// `crates/jounce-analysis/tests/orbits/attractors/basins.rs`, found by another method). At twice
/// its frequency the orbit with one impact per cycle is stable in closed form.
#[test]
fn chaos_and_a_period_are_distinguished() {
    let ending = |frequency_ratio: f64| {
        let oscillator = ImpactOscillator {
            frequency_ratio,
            damping_ratio: 0.05,
            restitution: 0.8,
            gap: 0.0,
        };
        let model = ReferenceModel::<1, 4>::of(&oscillator.system(0.3));
        classify(
            Flow {
                model: &model,
                tolerance: TOLERANCE,
                has_series: true,
            },
            &[-0.1, 0.0],
            Patience {
                cycles: 3000,
                period: 64,
            },
        )
    };
    let (chaos, orbit) = (ending(2.8), ending(2.0));
    eprintln!("{:?} {:?}, {:?}", chaos.kind, chaos.exponent, orbit.kind);
    assert!(chaos.kind == Kind::Chaos && orbit.kind == Kind::Periodic(1));
}

/// Pressed onto a rigid stop by a constant force, a mass bounces with decreasing height and comes
/// to rest.
#[test]
fn chatter_ends_at_rest() {
    let text = "[modal.h]\nfrequency_hz = [0.0]\ndamping_ratio = [0.0]\nparticipation_sqrt_kg = [1.0]\n[modal.h.point]\ntip = [1.0]\n\
         [stop.s]\nat = \"h.tip\"\ngap = \"0.1 m\"\nlaw = \"rigid\"\nrestitution = 0.7\n[gravity]\nacceleration = \"9.81 m/s^2\"\n\
         [drive.d]\nat = \"h.tip\"\namplitude = \"0 N\"\nfrequency = \"0.5 Hz\"\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";
    let system = system(text);
    let model = ReferenceModel::<1, 4>::of(&system);
    let flow = Flow {
        model: &model,
        tolerance: TOLERANCE,
        has_series: true,
    };
    let mut motion = flow.start(model.state(&[0.0, 0.0]));
    flow.cycle(&mut motion);
    assert!(
        (motion.state[0] - 0.1).abs() < 1e-15 && motion.state[1].abs() < 1e-15 && !motion.is_lost,
        "{:?}",
        motion.state
    );
}
