//! A free mass strikes a stop; each law is compared with its closed form.

use crate::plants::{integrate, kernel, physical, relative};
use jounce_model::plant::System;
use jounce_model::reference::{
    HertzCollision, HuntCrossleyCollision, KelvinVoigtCollision, Reference,
};

/// Result of a collision.
#[derive(Debug)]
struct Rebound {
    speed_m_s: f64,
    peak_penetration_m: f64,
    peak_force_n: f64,
    /// Computed from the straight flights before and after the contact.
    contact_time_s: f64,
    contacts: u64,
    loss_j: f64,
    residual: f64,
}

fn collide(
    system: System,
    start: &[f64],
    before_m: f64,
    speed_m_s: f64,
    end_s: f64,
    tolerance: f64,
) -> Rebound {
    let root_mass = 1.0 / system.stops[0].shape[0];
    let kernel = kernel(system);
    let integrator = integrate(&kernel, start, 0.0, end_s, tolerance);
    let state = physical(&integrator, &kernel);
    let (position_m, speed_after) = (state[0] / root_mass, state[1] / root_mass);
    let (statistics, energies) = (integrator.statistics(), integrator.energies());
    assert!(
        position_m < 0.0 && speed_after < 0.0,
        "still in contact: {position_m} m, {speed_after} m/s"
    );
    Rebound {
        speed_m_s: -speed_after,
        peak_penetration_m: statistics.max_penetration_m,
        peak_force_n: statistics.max_force_n,
        contact_time_s: end_s - position_m / speed_after - before_m / speed_m_s,
        contacts: statistics.contacts,
        loss_j: energies.contact_loss_j,
        residual: energies.residual_relative(),
    }
}

fn hertz(problem: &HertzCollision, tolerance: f64) -> Rebound {
    let contact_s = problem.contact_time_s();
    // Start one contact time away from the stop, so that roundoff of the flights does not hide the
    // contact.
    let before_m = 0.7 * contact_s * problem.speed_m_s;
    collide(
        problem.system(),
        &problem.start(before_m),
        before_m,
        problem.speed_m_s,
        3.1 * contact_s,
        tolerance,
    )
}

fn assert_hertz(problem: &HertzCollision, tolerance: f64, allowed: f64) {
    let rebound = hertz(problem, tolerance);
    let errors = [
        relative(rebound.speed_m_s, problem.speed_m_s),
        relative(rebound.peak_penetration_m, problem.peak_penetration_m()),
        relative(rebound.peak_force_n, problem.peak_force_n()),
        relative(rebound.contact_time_s, problem.contact_time_s()),
        rebound.residual.abs(),
    ];
    eprintln!(
        "k {:e}, n {}: speed, depth, force, time, energy {errors:?}",
        problem.stiffness, problem.exponent
    );
    assert!(
        rebound.contacts == 1 && errors.iter().all(|e| *e <= allowed),
        "{problem:?}: {rebound:?}: {errors:?}"
    );
}

#[test]
fn hertz_collision_at_any_stiffness() {
    for stiffness in [1e3, 1e8, 1e10] {
        let problem = HertzCollision {
            mass_kg: 0.01,
            speed_m_s: 0.5,
            stiffness,
            exponent: 1.5,
        };
        assert_hertz(&problem, 1e-10, HertzCollision::TOLERANCE);
    }
}

#[test]
fn collision_with_a_linear_spring_and_other_exponents() {
    for exponent in [1.0, 1.25, 2.0, 3.0] {
        let problem = HertzCollision {
            mass_kg: 0.3,
            speed_m_s: 1.2,
            stiffness: 4e5,
            exponent,
        };
        assert_hertz(&problem, 1e-10, HertzCollision::TOLERANCE);
    }
}

#[test]
fn error_of_a_collision_stays_below_the_tolerance() {
    let problem = HertzCollision {
        mass_kg: 0.01,
        speed_m_s: 0.5,
        stiffness: 1e6,
        exponent: 1.5,
    };
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
        assert_hertz(&problem, tolerance, tolerance);
    }
}

#[test]
fn kelvin_voigt_collision_loses_the_energy_of_the_closed_form() {
    for damping_n_s_m in [0.02, 2.0, 20.0, 60.0] {
        let problem = KelvinVoigtCollision {
            mass_kg: 0.1,
            speed_m_s: 0.8,
            stiffness_n_m: 1e4,
            damping_n_s_m,
        };
        let push_s = problem.push_time_s();
        let before_m = 0.5 * push_s * problem.speed_m_s;
        // After the push the mass coasts out of the stop, slowly with strong damping.
        let rebound = collide(
            problem.system(),
            &problem.start(before_m),
            before_m,
            problem.speed_m_s,
            40.0 * push_s,
            1e-10,
        );
        let e = problem.restitution();
        let loss_j = 0.5 * problem.mass_kg * problem.speed_m_s.powi(2) * (1.0 - e * e);
        let errors = [
            relative(rebound.speed_m_s, e * problem.speed_m_s),
            relative(rebound.loss_j, loss_j),
            rebound.residual.abs(),
        ];
        eprintln!(
            "c {damping_n_s_m}, zeta {:.3}: speed, loss, energy {errors:?}",
            problem.damping_ratio()
        );
        // The loss of a light dashpot is a small difference of large energies.
        let amplified = 1.0 / (1.0 - e * e);
        assert!(
            errors[0] <= 1e-8 && errors[1] <= 1e-8 * amplified && errors[2] <= 1e-8,
            "{problem:?}: {rebound:?}: {errors:?}"
        );
    }
}

#[test]
fn hunt_crossley_collision_loses_the_energy_of_the_closed_form() {
    for (exponent, damping_s_m) in [(1.5, 0.01), (1.5, 0.3), (1.5, 3.0), (1.0, 0.3), (2.0, 0.3)] {
        let problem = HuntCrossleyCollision {
            mass_kg: 0.1,
            speed_m_s: 0.8,
            stiffness: 1e5,
            exponent,
            damping_s_m,
        };
        let elastic = HertzCollision {
            mass_kg: 0.1,
            speed_m_s: 0.8,
            stiffness: 1e5,
            exponent,
        };
        let contact_s = elastic.contact_time_s();
        let before_m = 0.5 * contact_s * problem.speed_m_s;
        let rebound = collide(
            problem.system(),
            &problem.start(before_m),
            before_m,
            problem.speed_m_s,
            20.0 * contact_s,
            1e-10,
        );
        let e = problem.restitution();
        let loss_j = 0.5 * problem.mass_kg * problem.speed_m_s.powi(2) * (1.0 - e * e);
        let errors = [
            relative(rebound.speed_m_s, e * problem.speed_m_s),
            relative(rebound.peak_penetration_m, problem.peak_penetration_m()),
            relative(rebound.loss_j, loss_j),
            rebound.residual.abs(),
        ];
        eprintln!("n {exponent}, a {damping_s_m}, e {e:.3}: speed, depth, loss, energy {errors:?}");
        let amplified = 1.0 / (1.0 - e * e);
        let allowed = HuntCrossleyCollision::TOLERANCE;
        assert!(
            errors[0].max(errors[1]).max(errors[3]) <= allowed && errors[2] <= allowed * amplified,
            "{problem:?}: {rebound:?}: {errors:?}"
        );
    }
}
