//! For every law, for two stops and for rigid stops.

use super::{START_S, jacobian_error, state_after_contacts, with_law};
use crate::contacts::several_stops::{between_stops, coupled};
use crate::plants::{bench, kernel};
use jounce_dynamics::{FlowSensitivity, Integrator, ParameterSensitivity};
use jounce_model::contact::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Law, Rigid, Table};
use jounce_model::reference::ImpactOscillator;
use jounce_spec::ForceCurve;

#[test]
fn jacobian_is_the_difference_of_flows_for_every_law() {
    let hertz = Hertz {
        stiffness: 1000.0,
        exponent: 1.5,
    };
    for (name, law) in [
        ("hertz", Law::Hertz(hertz)),
        (
            "spring",
            Law::Hertz(Hertz {
                stiffness: 100.0,
                exponent: 1.0,
            }),
        ),
        (
            "kelvin-voigt",
            Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: 100.0,
                damping_n_s_m: 0.1,
            }),
        ),
        (
            "hunt-crossley",
            Law::HuntCrossley(HuntCrossley {
                elastic: hertz,
                damping_s_m: 0.3,
            }),
        ),
        (
            "cubic",
            Law::Cubic(Cubic {
                stiffness_n_m: 10.0,
                cubic_stiffness_n_m3: 1e5,
            }),
        ),
        (
            "table",
            Law::Table(Table::new(
                ForceCurve::through(&[1e-4, 3e-4, 2e-3], &[1e-3, 7e-3, 0.1]).unwrap(),
                0.3,
            )),
        ),
    ] {
        let kernel = kernel(with_law(bench(50.0, 11.0), law));
        let (y, period_s) = state_after_contacts(&kernel);
        let largest_error = jacobian_error(&kernel, &y, period_s);
        eprintln!("{name}: {largest_error:.1e}");
        assert!(largest_error < 1e-5, "{name}: {largest_error:e}");
    }
}

#[test]
fn jacobian_is_the_difference_of_flows_for_two_stops() {
    let mut mixed = coupled();
    mixed.stops[0].law = Law::KelvinVoigt(KelvinVoigt {
        stiffness_n_m: 2e4,
        damping_n_s_m: 3.0,
    });
    mixed.stops[1].law = Law::HuntCrossley(HuntCrossley {
        elastic: Hertz {
            stiffness: 2e5,
            exponent: 1.5,
        },
        damping_s_m: 0.4,
    });
    let mut rigid = coupled();
    rigid.stops[1].law = Law::Rigid(Rigid { restitution: 0.8 });
    for (name, system, allowed) in [
        ("both sides", between_stops(100.0, 11.0), 1e-5),
        ("overlapping", coupled(), 1e-5),
        ("mixed", mixed, 1e-4),
        ("rigid", rigid, 1e-4),
    ] {
        let kernel = kernel(system);
        let (y, period_s) = state_after_contacts(&kernel);
        let largest_error = jacobian_error(&kernel, &y, period_s);
        eprintln!("{name}: {largest_error:.1e}");
        assert!(largest_error < allowed, "{name}: {largest_error:e}");
    }
}

/// With one mode the rebounds from a rigid stop are clean; many modes chatter.
#[test]
fn jacobian_is_the_difference_of_flows_for_a_rigid_stop() {
    let oscillator = ImpactOscillator {
        frequency_ratio: 0.8,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap: 0.5,
    };
    let kernel = kernel(oscillator.system(0.0));
    let (y, period_s) = state_after_contacts(&kernel);
    let largest_error = jacobian_error(&kernel, &y, period_s);
    eprintln!("rigid: {largest_error:.1e}");
    assert!(largest_error < 1e-6, "{largest_error:e}");
}

/// An elastic contact preserves volume: the determinant over a period is that of the linear plant,
/// `exp(T trace A)`.
#[test]
fn determinant_is_that_of_the_plant() {
    let kernel = kernel(bench(50.0, 11.0));
    let (y, period_s) = state_after_contacts(&kernel);
    let sensitivity = FlowSensitivity::integrate(
        &kernel,
        &y,
        START_S,
        period_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    let trace: f64 = kernel
        .plant
        .diagonal
        .block
        .eigenvalues()
        .iter()
        .map(|value| value.re)
        .sum();
    let jacobian_error =
        jounce_linalg::determinant(&sensitivity.jacobian) / (trace * period_s).exp() - 1.0;
    eprintln!("determinant: {jacobian_error:.1e}");
    assert!(jacobian_error.abs() < 1e-6, "{jacobian_error:e}");
}

/// Trace and determinant of the period map of the impact oscillator.
#[test]
fn rigid_impact_has_the_multipliers_of_the_closed_form() {
    for (frequency_ratio, damping_ratio, gap) in [(0.8, 0.05, 0.5), (2.0, 1e-6, 0.0)] {
        let oscillator = ImpactOscillator {
            frequency_ratio,
            damping_ratio,
            restitution: 0.8,
            gap,
        };
        let orbit = oscillator.orbits(1)[0];
        let kernel = kernel(oscillator.system(orbit.angle_rad));
        let period_s = std::f64::consts::TAU / frequency_ratio;
        let mut integrator = Integrator::new(
            &kernel,
            &kernel.plant.from_physical(&oscillator.start(&orbit), 0.0),
            0.0,
            1e-13,
        )
        .unwrap();
        integrator.advance_to(0.4 * period_s).unwrap();
        let sensitivity = FlowSensitivity::integrate(
            &kernel,
            &integrator.state(),
            0.4 * period_s,
            period_s,
            1e-13,
            &ParameterSensitivity::default(),
        )
        .unwrap();
        let [trace, determinant] = orbit.trace_determinant;
        let errors = [
            sensitivity.jacobian[(0, 0)] + sensitivity.jacobian[(1, 1)] - trace,
            jounce_linalg::determinant(&sensitivity.jacobian) - determinant,
        ];
        eprintln!("w = {frequency_ratio}: errors {errors:?}");
        assert!(
            errors[0].abs() < 1e-9 && errors[1].abs() < 1e-9,
            "{errors:?}"
        );
    }
}
