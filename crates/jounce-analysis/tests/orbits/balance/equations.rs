//! The equations of harmonic balance: number of harmonics, derivatives, work and errors.

use super::{HERTZ, parameter_change_error, refined, system};
use crate::harvesters::{Systems, bench};
use jounce_analysis::{Model, Parameter, settled_orbit};
use jounce_continuation::{ContinuationError, Corrector, Metric, Position, correct_at};
use jounce_model::contact::{Law, Rigid};
use jounce_orbits::{HarmonicBalance, OrbitError, OrbitMethod, ParametricModel, Shooting};
use jounce_spec::SpecFile;

/// The number of harmonics increases by a half and decreases by a third, between limits.
#[test]
fn the_number_of_harmonics_has_two_limits() {
    let harvester = Systems(|frequency_hz| system(frequency_hz, Law::Hertz(HERTZ)));
    let kernel = harvester.at(11.0).unwrap().kernel;
    let method = |harmonics: usize| {
        HarmonicBalance::new(
            Shooting::new(&harvester, &kernel, 1, 1e-9),
            &kernel,
            harmonics,
            3e-7,
        )
        .unwrap()
    };
    assert_eq!(method(64).finer().map(|finer| finer.harmonics), Some(96));
    assert_eq!(
        method(96).coarser().map(|coarser| coarser.harmonics),
        Some(64)
    );
    assert!(method(1000).finer().is_none() && method(20).coarser().is_none());
    assert_eq!(method(16).resampled(&[1.0; 65]), [1.0; 33]);
}

#[test]
fn a_rigid_stop_is_refused_with_the_other_method_named() {
    let law = Law::Rigid(Rigid { restitution: 0.8 });
    let harvester = Systems(|frequency_hz| system(frequency_hz, law));
    let kernel = harvester.at(11.0).unwrap().kernel;
    let refused = HarmonicBalance::new(
        Shooting::new(&harvester, &kernel, 1, 1e-9),
        &kernel,
        64,
        1e-7,
    )
    .err()
    .unwrap();
    assert!(
        matches!(refused, OrbitError::Impulsive { .. }) && refused.to_string().contains("shooting"),
        "{refused}"
    );
}

/// Derivatives by the parameter in closed form against differences: frequency, amplitude, gap and
/// stiffness.
#[test]
fn the_change_with_the_parameter_is_that_of_differences() {
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    for (name, value) in [
        ("drive.shaker.frequency", 11.0),
        ("drive.shaker.amplitude", 50.0),
        ("stop.tip.gap", 1e-3),
        ("stop.tip.stiffness", 1000.0),
    ] {
        let key = file.numeric_key(name).unwrap();
        let parameter = Parameter::new(&base, &key, value);
        let kernel = parameter.at(value).unwrap().kernel;
        let exact = settled_orbit(
            &parameter,
            value,
            &vec![0.0; kernel.plant.len()],
            1e-10,
            1e-9,
        )
        .unwrap();
        let method = HarmonicBalance::new(
            Shooting::new(&parameter, &kernel, 1, 1e-10),
            &kernel,
            64,
            1e-8,
        )
        .unwrap();
        let unknown = method.unknown_of(exact.start(), value).unwrap();
        let error = parameter_change_error(&method, &unknown, value);
        eprintln!("{name}: {error:.1e}");
        // At most 3e-10; 3e-7 for the gap, whose contact edges move the nodes and so change the
        // quadrature error in the difference.
        assert!(error < 1e-6, "{name}: {error:e}");
    }
}

/// The problem size is independent of the number of modes of the plant: harmonics, nodes in
/// contact, Newton evaluations.
#[test]
fn the_work_at_a_point_is_flat_in_the_number_of_modes() {
    let mut report = String::new();
    for modes in [8, 24, 40] {
        let mut file = SpecFile::from_text(include_str!(
            "../../../../../examples/impact-harvester-2019/harvester.toml"
        ));
        file.set("reduction.modes", &modes.to_string()).unwrap();
        let known = [0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.0016];
        let ratios: Vec<f64> = (0..modes - 1).map(|mode| known[mode.min(6)]).collect();
        file.set("damping.ratios", &format!("{ratios:?}")).unwrap();
        file.set("drive.shaker.amplitude", "\"50 N\"").unwrap();
        let base = Model::new(file.spec().unwrap()).unwrap();
        let key = file.numeric_key("drive.shaker.frequency").unwrap();
        let parameter = Parameter::new(&base, &key, 16.0);
        let kernel = parameter.at(11.0).unwrap().kernel;
        let start =
            settled_orbit(&parameter, 11.0, &vec![0.0; kernel.plant.len()], 1e-9, 1e-8).unwrap();
        let method = HarmonicBalance::new(
            Shooting::new(&parameter, &kernel, 1, 1e-9),
            &kernel,
            64,
            3e-7,
        )
        .unwrap();
        let (method, solution) = refined(method, start.start(), 11.0);
        report += &format!(
            "{modes} modes: {} harmonics, {} nodes, {} evaluations\n",
            method.harmonics,
            solution.local.nodes(),
            solution.evaluations
        );
    }
    insta::assert_snapshot!(report);
}

/// When Newton fails, the error lists the residual by harmonic: for a contact-free orbit, the shift
/// of the third one.
#[test]
fn a_failure_reports_the_residual_by_harmonic() {
    let harvester = Systems(|frequency_hz| {
        let mut system = system(frequency_hz, Law::Hertz(HERTZ));
        system.stops[0].gap_m = 0.5;
        system
    });
    let kernel = harvester.at(11.0).unwrap().kernel;
    let method = HarmonicBalance::new(
        Shooting::new(&harvester, &kernel, 1, 1e-11),
        &kernel,
        16,
        0.0,
    )
    .unwrap();
    let steady = method.shooting.unknown(
        &kernel
            .plant
            .to_physical(&vec![0.0; kernel.plant.len()], 0.0),
    );
    let mut unknown = method.unknown_of(&steady, 11.0).unwrap();
    (unknown[5], unknown[6]) = (unknown[5] + 3e-7, unknown[6] - 4e-7);
    let position = Position {
        unknown,
        parameter: 11.0,
    };
    let one_iteration = Corrector {
        goal: 1e-10,
        most: 1,
    };
    let failed = correct_at(
        &method,
        &one_iteration,
        &Metric::at(&position, 1.0),
        position,
    )
    .unwrap_err();
    let ContinuationError::Diverged { left, .. } = &failed else {
        panic!("{failed}")
    };
    let [mean, first, second, third, ..] = &left.sizes[..] else {
        panic!("{left:?}")
    };
    assert!(
        third.0 == "harmonic 3" && (third.1 / 5e-7 - 1.0).abs() < 1e-6,
        "{third:?}"
    );
    assert!(
        mean.1.max(first.1).max(second.1) < 1e-12 && left.sizes.len() == 17,
        "{left:?}"
    );
    assert!(
        failed
            .to_string()
            .contains("largest in harmonic 3 5.0e-7 m rms"),
        "{failed}"
    );
}
