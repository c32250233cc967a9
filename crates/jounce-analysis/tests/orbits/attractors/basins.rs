//! Attractors and their shares against plain integrations, and Lyapunov exponents against closed
//! forms.

use crate::harvesters::bench;
use jounce_analysis::largest_exponent;
use jounce_analysis::{
    AttractorKind, Basins, BasinsResult, Cloud, Grid, GridAxis, GridSide, InitialStates, Model,
    Parameter, Recognition, SectionPoint,
};
use jounce_dynamics::{Integrator, Kernel};
use jounce_model::reference::ImpactOscillator;
use jounce_orbits::ParametricModel;
use jounce_spec::Spec;
use std::f64::consts::TAU;

const CLOUD: Cloud = Cloud {
    starts: 24,
    seed: 3,
    spread: 20.0,
};

/// Model of the bench at a frequency.
fn at(frequency_hz: f64) -> Model {
    let mut spec = bench().spec().unwrap();
    spec.set_si("drive.shaker.frequency", frequency_hz).unwrap();
    Model::new(spec).unwrap()
}

fn basins(frequency_hz: f64) -> BasinsResult {
    let base = at(frequency_hz);
    Basins {
        base: &base,
        starts: InitialStates::Cloud(CLOUD),
        recognition: Recognition::at(1e-8),
    }
    .run()
    .unwrap()
}

/// Mean power over the last cycles of a long integration.
fn integrated_power_w(kernel: &Kernel, start: &[f64], frequency_hz: f64) -> f64 {
    let mut integrator =
        Integrator::new(kernel, &kernel.plant.from_physical(start, 0.0), 0.0, 1e-8).unwrap();
    integrator.advance_to(4800.0 / frequency_hz).unwrap();
    let before: f64 = integrator.energies().loads_j.iter().sum();
    integrator.advance_to(4812.0 / frequency_hz).unwrap();
    (integrator.energies().loads_j.iter().sum::<f64>() - before) * frequency_hz / 12.0
}

#[test]
fn fractions_are_those_of_plain_integrations() {
    let frequency_hz = 14.0;
    let result = basins(frequency_hz);
    for a in &result.attractors {
        eprintln!("{}: {:.6e} W, {:?}", a.id, a.mean_power_w, a.share);
    }
    assert!(
        result.attractors.len() > 1,
        "two attractors are known at 14 Hz"
    );
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let kernel = Parameter::new(&base, &key, 1.0)
        .at(frequency_hz)
        .unwrap()
        .kernel;
    let mut sum = 0.0;
    for index in 0..CLOUD.starts {
        let power_w = integrated_power_w(&kernel, &CLOUD.start(&kernel.plant, index), frequency_hz);
        let home = result
            .attractors
            .iter()
            .find(|a| a.starts.contains(&index))
            .unwrap();
        assert!(
            (power_w / home.mean_power_w - 1.0).abs() < 1e-4,
            "start {index}: {power_w:e} W, not on {}",
            home.id
        );
        sum += power_w / CLOUD.starts as f64;
    }
    assert!(
        (result.expected_power_w / sum - 1.0).abs() < 1e-4,
        "{} {sum}",
        result.expected_power_w
    );
    assert!(result.expected_power_low_w < sum && sum < result.expected_power_high_w);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let run_on = |threads: usize| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
            .install(|| basins(14.0))
    };
    assert_eq!(run_on(1), run_on(3));
}

/// The full range of the harvester by several point clouds: slow transients are neither undecided
/// nor classified as chaos. The torus at 12.3 Hz is one such case: its motion fills a closed curve,
/// and neighbours neither separate nor converge.
#[test]
#[ignore = "long: runs with ./test --long"]
fn slow_transients_are_recognised_at_every_frequency() {
    for (value, seed) in [
        (5.0, 1),
        (8.0, 2),
        (11.0, 5),
        (12.3, 3),
        (13.0, 1),
        (13.34, 2),
        (16.0, 5),
        (19.0, 1),
    ] {
        let starts = InitialStates::Cloud(Cloud {
            starts: 12,
            seed,
            spread: 10.0,
        });
        let base = at(value);
        let result = Basins {
            base: &base,
            starts,
            recognition: Recognition::at(1e-8),
        }
        .run()
        .unwrap();
        let ids: Vec<&str> = result.attractors.iter().map(|a| a.id.as_str()).collect();
        eprintln!("{value} Hz: {ids:?}");
        let is_aperiodic =
            |id: &str| ["chaos", "undecided"].contains(&id) || (id == "torus" && value != 12.3);
        assert!(
            result.lost.is_empty() && !ids.iter().any(|id| is_aperiodic(id)),
            "{value} Hz: {ids:?}"
        );
    }
}

/// A displacement axis applies a static force, a velocity axis an impulse: the stop's point has
/// exactly that displacement and speed.
#[test]
fn a_grid_starts_at_its_limits() {
    let plant = Model::new(bench().spec().unwrap()).unwrap().kernel.plant;
    let side = |axis: GridAxis, from: f64, to: f64, count: usize| GridSide {
        axis,
        from,
        to,
        count,
    };
    let sides = vec![
        side(GridAxis::Displacement, -5e-3, 5e-3, 3),
        side(GridAxis::Velocity, -0.5, 0.5, 2),
        side(GridAxis::Voltage, 1.0, 2.0, 2),
    ];
    let grid = Grid { sides };
    assert_eq!(grid.len(), 12);
    let point = SectionPoint::of(&plant.system, &grid.start(&plant, 2 + 3 + 6));
    assert!(
        (point.displacement_m - 5e-3).abs() < 1e-15
            && (point.velocity_m_s - 0.5).abs() < 1e-13
            && point.voltage_v == 2.0,
        "{point:?}"
    );
}

/// Drives without a common period have no cycle, and so no attractor of this kind.
#[test]
fn drives_without_a_common_period_have_no_attractor() {
    let second = "[drive.second]\nat = \"harvester.table\"\nkind = \"force\"\namplitude = \"1 N\"\n\
                  frequency = \"13.731 Hz\"\n";
    let text = format!("{}\n{second}", at(13.0).spec.to_toml());
    let base = Model::new(Spec::from_toml(&text).unwrap()).unwrap();
    assert_eq!(base.kernel.plant.period_s(), None);
    let cloud = Cloud { starts: 2, ..CLOUD };
    let result = Basins {
        base: &base,
        starts: InitialStates::Cloud(cloud),
        recognition: Recognition::at(1e-8),
    }
    .run()
    .unwrap();
    assert!(result.attractors.is_empty(), "{:?}", result.attractors);
}

/// Without contact every motion decays like the slowest mode.
#[test]
fn the_exponent_of_a_linear_plant_is_its_slowest_decay() {
    let mut file = bench();
    file.set("stop.tip.gap", "\"500 mm\"").unwrap();
    let kernel = Model::new(file.spec().unwrap()).unwrap().kernel;
    let slowest = kernel
        .plant
        .diagonal
        .block
        .eigenvalues()
        .iter()
        .map(|value| value.re)
        .fold(f64::NEG_INFINITY, f64::max);
    let exponent = largest_exponent(
        &kernel,
        &vec![0.0; kernel.plant.len()],
        (640, kernel.plant.period_s().unwrap()),
        1e-8,
    )
    .unwrap();
    eprintln!(
        "exponent {} +- {}, slowest decay {slowest}",
        exponent.exponent_per_s, exponent.error_per_s
    );
    assert!(
        (exponent.exponent_per_s / slowest - 1.0).abs() < 2e-2
            && exponent.kind() == AttractorKind::Undecided
    );
}

fn oscillator(gap: f64, frequency_ratio: f64) -> ImpactOscillator {
    ImpactOscillator {
        frequency_ratio,
        damping_ratio: 0.05,
        restitution: 0.8,
        gap,
    }
}

fn kernel(oscillator: &ImpactOscillator, angle_rad: f64) -> Kernel {
    Kernel::new(jounce_model::plant::Plant::new(oscillator.system(angle_rad)).unwrap()).unwrap()
}

/// Two multipliers of equal modulus: `ln |multiplier| / T` in closed form.
#[test]
fn the_exponent_of_a_stable_orbit_is_that_of_its_multiplier() {
    let oscillator = oscillator(1.0, 0.8);
    let orbit = oscillator.orbits(1).pop().unwrap();
    let [trace, determinant] = orbit.trace_determinant;
    let root = (trace * trace - 4.0 * determinant).max(0.0).sqrt();
    let exact = (0.5 * (trace.abs() + root)).max(determinant.sqrt()).ln() * 0.8 / TAU;
    // The drive starts a third of a cycle after the impact.
    let angle_rad = orbit.angle_rad + TAU / 3.0;
    let kernel = kernel(&oscillator, angle_rad);
    let start_s = (orbit.angle_rad - angle_rad).rem_euclid(TAU) / 0.8;
    let y = kernel
        .plant
        .from_physical(&oscillator.start(&orbit), start_s);
    let mut integrator = Integrator::new(&kernel, &y, start_s, 1e-12).unwrap();
    integrator.advance_to(TAU / 0.8).unwrap();
    let exponent = largest_exponent(&kernel, &integrator.state(), (320, TAU / 0.8), 1e-12).unwrap();
    eprintln!(
        "{} +- {}, closed form {exact}",
        exponent.exponent_per_s, exponent.error_per_s
    );
    assert!(
        (exponent.exponent_per_s / exact - 1.0).abs() < 2e-2
            && exponent.kind() == AttractorKind::Undecided
    );
}

/// Chaos at `w = 2.8` on a stop without gap: two neighbouring integrations separate at the rate of
/// the exponent.
#[test]
fn chaos_is_identified_by_its_exponent() {
    let kernel = kernel(&oscillator(0.0, 2.8), 0.3);
    let cycle_s = TAU / 2.8;
    let after_cycle = |y: &[f64]| {
        let mut integrator = Integrator::new(&kernel, y, 0.0, 1e-12).unwrap();
        integrator.advance_to(cycle_s).unwrap();
        integrator.state()
    };
    let mut y = kernel.plant.from_physical(&[-0.1, 0.0], 0.0);
    (0..200).for_each(|_| y = after_cycle(&y));
    let exponent = largest_exponent(&kernel, &y, (1600, cycle_s), 1e-12).unwrap();
    let (cycles, separation) = (1600, 1e-8);
    let mut other = y.clone();
    other[0] += separation;
    let mut growth = 0.0;
    for _ in 0..cycles {
        (y, other) = (after_cycle(&y), after_cycle(&other));
        let distance = y
            .iter()
            .zip(&other)
            .map(|(a, b)| (a - b).powi(2))
            .sum::<f64>()
            .sqrt();
        growth += (distance / separation).ln();
        other = y
            .iter()
            .zip(&other)
            .map(|(a, b)| a + (b - a) * separation / distance)
            .collect();
    }
    let two_trajectories = growth / (f64::from(cycles) * cycle_s);
    eprintln!(
        "exponent {} +- {}, two marches {two_trajectories}",
        exponent.exponent_per_s, exponent.error_per_s
    );
    assert!(exponent.kind() == AttractorKind::Chaos);
    assert!(
        (exponent.exponent_per_s - two_trajectories).abs() < 5.0 * exponent.error_per_s,
        "{} {two_trajectories}",
        exponent.exponent_per_s
    );
}
