//! Every start is assigned to the attractor on which a long integration ends.

use crate::harvesters::{bench, bench_with_keys};
use jounce_analysis::{
    AttractorKind, Basins, BasinsResult, Grid, GridAxis, GridSide, InitialStates, Model, Parameter,
    Recognition,
};
use jounce_dynamics::{Integrator, Kernel};
use jounce_orbits::{Orbit, ParametricModel, Shooting};
use jounce_spec::SpecFile;

/// Drive cycles of the long integration, for orbits of period 1, 3, 7, 10 and 18.
const LONG_CYCLES: u32 = 3_024;

fn grid(displacement_m: f64, velocity_m_s: f64, count: usize) -> InitialStates {
    let side = |axis: GridAxis, reach: f64| GridSide {
        axis,
        from: -reach,
        to: reach,
        count,
    };
    InitialStates::Grid(Grid {
        sides: vec![
            side(GridAxis::Displacement, displacement_m),
            side(GridAxis::Velocity, velocity_m_s),
        ],
    })
}

fn with_basins<T>(
    file: &SpecFile,
    starts: &InitialStates,
    tolerance: f64,
    then: impl FnOnce(&Parameter, f64, &BasinsResult) -> T,
) -> T {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let value = key.get(&base.spec).unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let recognition = Recognition::at(tolerance);
    let study = Basins {
        base: &base,
        starts: starts.clone(),
        recognition,
    };
    then(&parameter, value, &study.run().unwrap())
}

/// Physical state after the long integration from a physical state.
fn end_of_long_integration(kernel: &Kernel, start: &[f64], frequency_hz: f64) -> Vec<f64> {
    let y = kernel.plant.from_physical(start, 0.0);
    let mut integrator = Integrator::new(kernel, &y, 0.0, 1e-8).unwrap();
    integrator
        .advance_to(f64::from(LONG_CYCLES) / frequency_hz)
        .unwrap();
    integrator.physical()
}

/// Distance of a physical state from an orbit at its nearest drive cycle, relative to the size of
/// the orbit.
fn distance(shooting: &Shooting<Parameter>, orbit: &Orbit, physical: &[f64]) -> f64 {
    let state = shooting.unknown(physical);
    let separation = |strobe_state: &Vec<f64>| {
        strobe_state
            .iter()
            .zip(&state)
            .map(|(a, b)| (a - b).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    orbit
        .strobe_states
        .iter()
        .map(separation)
        .fold(f64::INFINITY, f64::min)
        / orbit.size()
}

/// Orbits of periods 1, 1, 3, 7, 10 and 18 attract at once. The one of period 18 gives
/// 6.027567570e-6 W by an independent integration, and on this grid 51 of 400 starts end there. A
/// recognition that tries periods up to 12 only would assign them to others.
#[test]
fn no_start_is_attributed_to_an_orbit_that_it_does_not_reach() {
    let file = bench_with_keys(&[
        ("drive.shaker.amplitude", "\"40 N\""),
        ("drive.shaker.frequency", "\"13.5 Hz\""),
        ("circuit.load.resistance", "\"100 kohm\""),
        ("stop.tip.stiffness", "\"10000 N/m^1.5\""),
        ("modal.harvester.damping_ratio.1", "0.3"),
    ]);
    let starts = grid(30e-3, 1.6, 20);
    with_basins(&file, &starts, 1e-8, |parameter, value, result| {
        let count = |period: u32| {
            result
                .attractors
                .iter()
                .filter(|a| a.period_cycles == period)
                .map(|a| a.starts.len())
                .sum::<usize>()
        };
        let counts = [1, 3, 7, 10, 18].map(count);
        eprintln!("{counts:?} of {}", starts.len());
        assert!(
            counts.iter().sum::<usize>() == starts.len() && counts[4] > 40,
            "{counts:?}"
        );
        let long = result
            .attractors
            .iter()
            .find(|a| a.period_cycles == 18)
            .unwrap();
        assert!(
            (long.mean_power_w / 6.027_567_570e-6 - 1.0).abs() < 1e-6,
            "{:e}",
            long.mean_power_w
        );
        assert!((long.orbit().unwrap().floquet_max_abs() - 0.364).abs() < 1e-3);
        let kernel = parameter.at(value).unwrap().kernel;
        let shooting = Shooting::new(parameter, &kernel, 1, 1e-8);
        for index in (0..starts.len()).step_by(9) {
            let home = result
                .attractors
                .iter()
                .find(|a| a.starts.contains(&index))
                .unwrap();
            let end = end_of_long_integration(&kernel, &starts.start(&kernel.plant, index), value);
            let distance_to_orbit = distance(&shooting, home.orbit().unwrap(), &end);
            assert!(
                distance_to_orbit < 1e-5,
                "start {index}: {distance_to_orbit:e} from {}",
                home.id
            );
        }
    });
}

/// The page integrates at 1e-6, the command line at 1e-8: both find equal attractors, and assign
/// each start to the same one.
#[test]
fn attractors_do_not_depend_on_the_tolerance() {
    let mut file = SpecFile::from_text(include_str!(
        "../../../../../examples/impact-harvester-2019/harvester.toml"
    ));
    file.set("drive.shaker.frequency", "\"12.55 Hz\"").unwrap();
    let starts = grid(15e-3, 1.2, 9);
    let at = |tolerance: f64| {
        with_basins(&file, &starts, tolerance, |_, _, result| {
            let listed = result
                .attractors
                .iter()
                .map(|a| (a.id.clone(), a.mean_power_w, a.starts.clone()));
            listed.collect::<Vec<_>>()
        })
    };
    let fine = at(1e-8);
    eprintln!(
        "{:?}",
        fine.iter()
            .map(|(id, power_w, starts)| (id, power_w, starts.len()))
            .collect::<Vec<_>>()
    );
    assert_eq!(fine.len(), 2);
    for coarse in [1e-6, 1e-7].map(at) {
        assert_eq!(coarse.len(), fine.len(), "{coarse:?}");
        for (one, two) in coarse.iter().zip(&fine) {
            assert!(
                one.0 == two.0 && (one.1 / two.1 - 1.0).abs() < 1e-4 && one.2 == two.2,
                "{one:?} {two:?}"
            );
        }
    }
}

/// A cycle budget too small for every start: no start is assigned, and the interval of the expected
/// power shows this.
#[test]
fn an_attractor_without_proof_is_undecided() {
    let base = Model::new(bench().spec().unwrap()).unwrap();
    let recognition = Recognition {
        max_cycles: 20,
        ..Recognition::at(1e-8)
    };
    let result = Basins {
        base: &base,
        starts: grid(5e-3, 0.5, 3),
        recognition,
    }
    .run()
    .unwrap();
    let [undecided] = &result.attractors[..] else {
        panic!("{result:?}")
    };
    assert!(
        undecided.kind == AttractorKind::Undecided
            && undecided.starts.len() == 9
            && undecided.id == "undecided"
    );
    assert!(
        result.expected_power_low_w == 0.0
            && result.expected_power_high_w >= result.expected_power_w
    );
}
