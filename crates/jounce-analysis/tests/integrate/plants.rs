//! Plants and runs shared by several tests.

use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_dynamics::{Integrator, Kernel};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes;
use jounce_spec::Spec;

/// System of a spec.
pub fn read(text: &str) -> System {
    let spec = Spec::from_toml(text).unwrap();
    System::assemble(&spec, modes(&spec).unwrap()).unwrap()
}

/// `bench/plant.toml`: the paper's harvester with eight modes.
pub fn bench(amplitude_n: f64, frequency_hz: f64) -> System {
    driven(
        read(include_str!("../../../../bench/plant.toml")),
        amplitude_n,
        frequency_hz,
    )
}

fn driven(mut system: System, amplitude_n: f64, frequency_hz: f64) -> System {
    system.drives[0].amplitude_n = amplitude_n;
    system.drives[0].frequency_hz = frequency_hz;
    system
}

pub fn kernel(system: System) -> Kernel {
    Kernel::new(Plant::new(system).unwrap()).unwrap()
}

/// Modes of unit mass, each its own coordinate; frequency 0 is a free mass.
pub fn springs(frequencies_hz: &[f64], damping_ratio: f64) -> System {
    let count = frequencies_hz.len();
    let modes = jounce_model::structure::Modes {
        frequency_rad_s: frequencies_hz
            .iter()
            .map(|f| std::f64::consts::TAU * f)
            .collect(),
        damping_ratio: vec![damping_ratio; count],
        shape: std::collections::BTreeMap::new(),
        patch: std::collections::BTreeMap::new(),
        participation_sqrt_kg: vec![1.0; count],
        base_sqrt_kg: std::collections::BTreeMap::new(),
        discretisation_error: vec![0.0; count],
        ..jounce_model::structure::Modes::default()
    };
    System {
        modes: modes.into(),
        ..System::default()
    }
}

/// A run from rest, averaged over its second half.
pub fn from_rest(kernel: &Kernel, duration_s: f64, tolerance: f64) -> RunResult {
    let plan = RunPlan {
        duration_s,
        average_over_s: 0.5 * duration_s,
        tolerance,
        record_s: 0.0,
    };
    simulate(kernel, &StartState::rest(&kernel.plant), &plan).unwrap()
}

/// Integrates from a physical state `(q, q', V)`.
pub fn integrate<'k>(
    kernel: &'k Kernel,
    start: &[f64],
    start_s: f64,
    end_s: f64,
    tolerance: f64,
) -> Integrator<'k> {
    let y = kernel.plant.from_physical(start, start_s);
    let mut integrator = Integrator::new(kernel, &y, start_s, tolerance).unwrap();
    integrator.advance_to(end_s).unwrap();
    integrator
}

/// Physical state `(q, q', V)` at the end of an integration.
pub fn physical(integrator: &Integrator, kernel: &Kernel) -> Vec<f64> {
    kernel
        .plant
        .to_physical(&integrator.state(), integrator.time_s())
}

/// Distance of two states in the energy norm, relative to the second.
pub fn distance(kernel: &Kernel, one: &[f64], other: &[f64]) -> f64 {
    let modes = &kernel.plant.system.modes;
    let n = modes.len();
    let weight = |i: usize| match i {
        i if i < n => modes.frequency_rad_s[i].max(f64::MIN_POSITIVE),
        i if i < 2 * n => 1.0,
        _ => modes
            .patch
            .values()
            .nth(i - 2 * n)
            .unwrap()
            .capacitance_f
            .sqrt(),
    };
    let norm = |value: &dyn Fn(usize) -> f64| {
        (0..one.len())
            .map(|i| (weight(i) * value(i)).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    norm(&|i| one[i] - other[i]) / norm(&|i| other[i])
}

pub fn relative(value: f64, expected: f64) -> f64 {
    (value / expected - 1.0).abs()
}
