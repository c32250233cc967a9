//! Contacts by a table: against the power law that it samples, and a spring in closed form.

use crate::plants::{bench, from_rest, integrate, kernel, physical, relative};
use jounce_model::contact::{ContactLaw, Hertz, HuntCrossley, Law, Table};
use jounce_model::plant::System;
use jounce_model::reference::HertzCollision;
use jounce_spec::ForceCurve;

/// Table with points that are denser near the start, up to a penetration.
fn sampled(law: &impl ContactLaw, deepest_m: f64, count: u32, damping_s_m: f64) -> Law {
    let at: Vec<f64> = (1..=count)
        .map(|k| deepest_m * (f64::from(k) / f64::from(count)).powi(2))
        .collect();
    let force: Vec<f64> = at.iter().map(|at| law.elastic_force_n(*at)).collect();
    Law::Table(Table::new(
        ForceCurve::through(&at, &force).unwrap(),
        damping_s_m,
    ))
}

fn with_law(mut system: System, law: Law) -> System {
    system.stops[0].law = law;
    system
}

const HERTZ: Hertz = Hertz {
    stiffness: 1000.0,
    exponent: 1.5,
};

/// A free mass rebounds from a table of one point, a spring, after half a period; it penetrates
/// past the point, where the last slope continues.
#[test]
fn one_point_is_a_spring() {
    let problem = HertzCollision {
        mass_kg: 0.01,
        speed_m_s: 0.5,
        stiffness: 1e4,
        exponent: 1.0,
    };
    let (deepest_m, contact_s) = (problem.peak_penetration_m(), problem.contact_time_s());
    let at_m = 0.3 * deepest_m;
    let curve = ForceCurve::through(&[at_m], &[1e4 * at_m]).unwrap();
    let kernel = kernel(with_law(
        problem.system(),
        Law::Table(Table::new(curve, 0.0)),
    ));
    let before_m = 0.7 * contact_s * problem.speed_m_s;
    let start = problem.start(before_m);
    let integrator = integrate(&kernel, &start, 0.0, 3.1 * contact_s, 1e-10);
    let statistics = integrator.statistics();
    assert_eq!(statistics.contacts, 1);
    for (value, exact) in [
        (-physical(&integrator, &kernel)[1], 0.1 * problem.speed_m_s),
        (statistics.max_penetration_m, deepest_m),
        (statistics.max_force_n, problem.peak_force_n()),
        (statistics.time_s, contact_s),
    ] {
        assert!(relative(value, exact) < 1e-8, "{value:e} {exact:e}");
    }
    assert!(integrator.energies().residual_relative().abs() < 1e-8);
}

/// The paper's harvester over 10 s with a table of its own law: the same contacts, and power,
/// penetration and elastic force to 1e-6. Measured: 1e-8 or less.
#[test]
fn a_fine_table_of_hertz_is_hertz() {
    let damped = HuntCrossley {
        elastic: HERTZ,
        damping_s_m: 0.3,
    };
    for (law, damping_s_m) in [(Law::Hertz(HERTZ), 0.0), (Law::HuntCrossley(damped), 0.3)] {
        let system = bench(50.0, 11.0);
        let exact = from_rest(&kernel(with_law(system.clone(), law)), 10.0, 1e-10);
        let deepest_m = 1.1 * exact.max_penetration_m;
        let table = sampled(&HERTZ, deepest_m, 2000, damping_s_m);
        let computed = from_rest(&kernel(with_law(system, table)), 10.0, 1e-10);
        let errors = [
            relative(computed.mean_power_w, exact.mean_power_w),
            relative(computed.max_penetration_m, exact.max_penetration_m),
            relative(computed.max_contact_force_n, exact.max_contact_force_n),
        ];
        eprintln!("{} contacts, {errors:?}", exact.contacts_in_all);
        assert!(exact.contacts_in_all > 50);
        assert_eq!(computed.contacts_in_all, exact.contacts_in_all);
        // The largest damped force is that at the nodes of the steps, which differ.
        let compared = if damping_s_m > 0.0 { 2 } else { 3 };
        assert!(
            errors[..compared].iter().all(|error| *error < 1e-6),
            "{errors:?}"
        );
        assert!(computed.energies.residual_relative().abs() < 1e-8);
    }
}

/// Few points make corners of the second derivative; the energy balance and the count of contacts
/// do not depend on the tolerance.
#[test]
fn a_coarse_table_conserves_energy_at_every_tolerance() {
    let table = sampled(&HERTZ, 5e-3, 5, 0.0);
    let count = |tolerance: f64| {
        let result = from_rest(&kernel(with_law(bench(50.0, 11.0), table)), 4.0, tolerance);
        let residual = result.energies.residual_relative();
        assert!(
            residual.abs() < 10.0 * tolerance,
            "{tolerance:e}: {residual:e}"
        );
        (result.contacts_in_all, result.mean_power_w)
    };
    let (contacts, power_w) = count(1e-11);
    for tolerance in [1e-6, 1e-8] {
        let other = count(tolerance);
        assert_eq!(other.0, contacts, "{tolerance:e}");
        assert!(relative(other.1, power_w) < 1e-3, "{tolerance:e}");
    }
}
