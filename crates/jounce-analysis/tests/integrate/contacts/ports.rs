//! Several ports: against single runs, their mirror image, RK4 and their energy balance.

use super::several_stops::{between_stops, coupled, driven, stop};
use crate::plants::{distance, from_rest, integrate, kernel, physical, relative, springs};
use jounce_model::contact::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Law, Rigid};
use jounce_model::plant::System;

const HERTZ: Law = Law::Hertz(Hertz {
    stiffness: 1000.0,
    exponent: 1.5,
});

/// Fourth-order Runge-Kutta on the modal equations with the contact laws.
fn runge_kutta(system: &System, start: &[f64], end_s: f64, steps: u32) -> Vec<f64> {
    let n = system.modes.len();
    let rate = |t: f64, x: &[f64]| -> Vec<f64> {
        let mut force = vec![0.0; n];
        for drive in &system.drives {
            let push_n = drive.amplitude_n
                * (std::f64::consts::TAU * drive.frequency_hz * t + drive.phase_rad).sin();
            force
                .iter_mut()
                .zip(&drive.shape)
                .for_each(|(f, s)| *f += s * push_n);
        }
        for stop in &system.stops {
            let along = |part: &[f64]| stop.shape.iter().zip(part).map(|(s, x)| s * x).sum::<f64>();
            let push_n = stop
                .law
                .force_n(along(&x[..n]) - stop.gap_m, along(&x[n..]));
            force
                .iter_mut()
                .zip(&stop.shape)
                .for_each(|(f, s)| *f -= s * push_n);
        }
        let spring = |i: usize| {
            let w = system.modes.frequency_rad_s[i];
            force[i] - 2.0 * system.modes.damping_ratio[i] * w * x[n + i] - w * w * x[i]
        };
        x[n..].iter().copied().chain((0..n).map(spring)).collect()
    };
    let (mut x, h) = (start.to_vec(), end_s / f64::from(steps));
    let moved = |x: &[f64], by: f64, k: &[f64]| -> Vec<f64> {
        x.iter().zip(k).map(|(x, k)| x + by * k).collect()
    };
    for step in 0..steps {
        let t = h * f64::from(step);
        let k1 = rate(t, &x);
        let k2 = rate(t + 0.5 * h, &moved(&x, 0.5 * h, &k1));
        let k3 = rate(t + 0.5 * h, &moved(&x, 0.5 * h, &k2));
        let k4 = rate(t + h, &moved(&x, h, &k3));
        (0..2 * n).for_each(|i| x[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    x
}

/// The motion of one of two independent oscillators does not depend on the other.
#[test]
fn independent_oscillators_are_two_single_runs() {
    let mut both = driven(springs(&[10.0, 13.7], 0.02), &[1.0, 1.0], 30.0, 11.0);
    both.stops.push(stop("one", &[1.0, 0.0], 4e-3, HERTZ));
    both.stops.push(stop(
        "two",
        &[0.0, 1.0],
        3e-3,
        Law::HuntCrossley(HuntCrossley {
            elastic: Hertz {
                stiffness: 3e4,
                exponent: 1.5,
            },
            damping_s_m: 0.2,
        }),
    ));
    let (start, end_s) = ([0.0; 4], 2.0);
    let joint = kernel(both.clone());
    let joint_run = integrate(&joint, &start, 0.0, end_s, 1e-13);
    let contacts: Vec<u64> = joint_run
        .statistics_by_stop()
        .iter()
        .map(|statistics| statistics.contacts)
        .collect();
    for index in 0..2 {
        let mut single = both.clone();
        single.stops = vec![both.stops[index].clone()];
        let single = kernel(single);
        let single_run = integrate(&single, &start, 0.0, end_s, 1e-13);
        let (a, b) = (physical(&joint_run, &joint), physical(&single_run, &single));
        let error = (a[index] - b[index])
            .abs()
            .max((a[2 + index] - b[2 + index]).abs() / 60.0)
            / b[index].abs().max(b[2 + index].abs() / 60.0);
        let (many, few) = (
            joint_run.statistics_by_stop()[index],
            single_run.statistics(),
        );
        let depth = relative(many.max_penetration_m, few.max_penetration_m);
        eprintln!(
            "oscillator {index}: {error:.1e}, depth {depth:.1e}, {} contacts",
            few.contacts
        );
        assert!(
            few.contacts > 5 && contacts[index] == few.contacts,
            "{contacts:?} {}",
            few.contacts
        );
        assert!(
            error < 1e-10 && depth < 1e-10,
            "oscillator {index}: {error:e}, {depth:e}"
        );
    }
    assert_eq!(
        joint_run.statistics().contacts,
        contacts.iter().sum::<u64>()
    );
}

/// Swapping the sides of a harvester between two equal stops mirrors its motion.
#[test]
fn equal_stops_on_both_sides_mirror_the_motion() {
    let system = between_stops(60.0, 11.0);
    let mut mirrored_drive = system.clone();
    mirrored_drive.drives[0].phase_rad += std::f64::consts::PI;
    let (one, other) = (kernel(system), kernel(mirrored_drive));
    let rest = vec![0.0; one.plant.len()];
    let (a, b) = (
        integrate(&one, &rest, 0.0, 1.0, 1e-12),
        integrate(&other, &rest, 0.0, 1.0, 1e-12),
    );
    let mirrored: Vec<f64> = physical(&b, &other).iter().map(|x| -x).collect();
    let error = distance(&one, &physical(&a, &one), &mirrored);
    let (sides, swapped) = (a.statistics_by_stop(), b.statistics_by_stop());
    eprintln!(
        "mirror: {error:.1e}, {} and {} contacts",
        sides[0].contacts, sides[1].contacts
    );
    assert!(sides[0].contacts > 3 && sides[1].contacts > 3);
    assert_eq!(
        [sides[0].contacts, sides[1].contacts],
        [swapped[1].contacts, swapped[0].contacts]
    );
    assert!(error < 1e-9, "{error:e}");
}

/// Largest error of integrations relative to Runge-Kutta, at decreasing tolerances.
pub fn errors(system: &System, end_s: f64) -> Vec<f64> {
    let start = vec![0.0; 2 * system.modes.len()];
    let exact = runge_kutta(system, &start, end_s, 1_200_000);
    let kernel = kernel(system.clone());
    let reference_error = distance(
        &kernel,
        &runge_kutta(system, &start, end_s, 600_000),
        &exact,
    );
    let error = |tolerance| {
        let integrator = integrate(&kernel, &start, 0.0, end_s, tolerance);
        let statistics = integrator.statistics_by_stop();
        assert!(
            statistics
                .iter()
                .all(|port| port.contacts > 3 || port.time_s == end_s),
            "{statistics:?}"
        );
        distance(&kernel, &physical(&integrator, &kernel), &exact)
    };
    let errors = [1e-5, 1e-7, 1e-9, 1e-11].map(error).to_vec();
    eprintln!("reference {reference_error:.1e}, errors {errors:?}");
    assert!(reference_error < 1e-9);
    errors
}

/// Overlapping contacts, against Runge-Kutta. Measured: 3e-8, 2e-10, 6e-12, 3e-12; halving the
/// steps of the reference changes it by 2e-11.
#[test]
fn overlapping_contacts_agree_with_a_plain_integrator() {
    let errors = errors(&coupled(), 0.6);
    assert!(
        errors[0] < 1e-6
            && errors[1] < 0.1 * errors[0]
            && errors[2] < 0.1 * errors[1]
            && errors[3] < 1e-10,
        "{errors:?}"
    );
}

/// A two-sided spring together with a one-sided stop.
#[test]
fn a_cubic_spring_next_to_a_stop_agrees_with_a_plain_integrator() {
    let mut system = coupled();
    system.stops[0].law = Law::Cubic(Cubic {
        stiffness_n_m: 400.0,
        cubic_stiffness_n_m3: 1e6,
    });
    let errors = errors(&system, 0.6);
    assert!(errors[0] < 1e-4 && errors[3] < 1e-9, "{errors:?}");
}

/// The energy balance holds for all laws and overlaps of contacts.
#[test]
fn energies_balance() {
    let kelvin_voigt = Law::KelvinVoigt(KelvinVoigt {
        stiffness_n_m: 2e4,
        damping_n_s_m: 3.0,
    });
    let hunt_crossley = Law::HuntCrossley(HuntCrossley {
        elastic: Hertz {
            stiffness: 2e5,
            exponent: 1.5,
        },
        damping_s_m: 0.4,
    });
    let mut mixed = coupled();
    (mixed.stops[0].law, mixed.stops[1].law) = (kelvin_voigt, hunt_crossley);
    let mut rigid = coupled();
    rigid.stops[1].law = Law::Rigid(Rigid { restitution: 0.8 });
    for (name, system, allowed) in [
        ("overlapping", coupled(), 1e-12),
        ("mixed laws", mixed, 1e-9),
        ("both sides", between_stops(60.0, 11.0), 1e-12),
        ("rigid", rigid, 1e-9),
    ] {
        let kernel = kernel(system);
        let integrator = integrate(&kernel, &vec![0.0; kernel.plant.len()], 0.0, 1.0, 1e-12);
        let residual = integrator.energies().residual_relative();
        eprintln!("{name}: residual {residual:.1e}");
        assert!(
            integrator
                .statistics_by_stop()
                .iter()
                .all(|statistics| statistics.contacts > 3)
        );
        assert!(residual.abs() < allowed, "{name}: {residual:e}");
    }
}

/// A record gives the states and the forces of the integration.
#[test]
fn a_record_holds_both_forces() {
    let kernel = kernel(coupled());
    let mut integrator = jounce_dynamics::Integrator::new(
        &kernel,
        &kernel.plant.from_physical(&[0.0; 6], 0.0),
        0.0,
        1e-11,
    )
    .unwrap();
    integrator.start_record();
    integrator.advance_to(0.5).unwrap();
    let end = integrator.state();
    let trajectory = integrator.take_record();
    let instants = trajectory.at(
        &kernel,
        &(0..=5000).map(|k| 1e-4 * f64::from(k)).collect::<Vec<_>>(),
    );
    let last = instants.last().unwrap();
    let error = last
        .state
        .iter()
        .zip(&end)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
        / end.iter().fold(0.0_f64, |max, y| max.max(y.abs()));
    let mut both = 0;
    for at in &instants {
        let x = kernel.plant.to_physical(&at.state, at.time_s);
        for (stop, force_n) in kernel.plant.system.stops.iter().zip(&at.forces_n) {
            let depth_m = stop.shape.iter().zip(&x).map(|(s, q)| s * q).sum::<f64>() - stop.gap_m;
            assert!(
                (stop.law.force_n(depth_m, 0.0) - force_n).abs() < 1e-6 * 40.0,
                "at {} s: {force_n} N",
                at.time_s
            );
        }
        both += u32::from(at.forces_n.iter().all(|force_n| *force_n > 0.0));
    }
    eprintln!(
        "end {error:.1e}, both in contact at {both} of {} instants",
        instants.len()
    );
    assert!(error < 1e-10 && both > 10, "{error:e}, {both}");
}

#[test]
fn work_of_two_ports() {
    for (name, system) in [
        ("both-sides", between_stops(60.0, 11.0)),
        ("overlapping", coupled()),
    ] {
        let result = from_rest(&kernel(system), 4.0, 1e-7);
        insta::assert_debug_snapshot!(format!("work-ports-{name}"), result.work);
    }
}
