//! Runs of the examples.

use crate::rows::folder;
use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, RunResult, simulate};
use jounce_dynamics::{Integrator, Kernel};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes;
use jounce_spec::{Spec, SpecFile};

/// Spec of an example with some keys changed.
pub fn spec(example: &str, file: &str, settings: &[(&str, &str)]) -> Spec {
    let mut file = SpecFile::read(folder(example).join(file)).unwrap();
    for (key, value) in settings {
        file.set(key, value).unwrap();
    }
    file.spec().unwrap_or_else(|faults| panic!("{faults}"))
}

pub fn system(example: &str, file: &str, settings: &[(&str, &str)]) -> System {
    let spec = spec(example, file, settings);
    System::assemble(&spec, modes(&spec).unwrap()).unwrap()
}

pub fn kernel(system: System) -> Kernel {
    Kernel::new(Plant::new(system).unwrap()).unwrap()
}

/// Run as specified in a spec.
pub fn run(example: &str, file: &str, settings: &[(&str, &str)]) -> (Kernel, RunResult) {
    let spec = spec(example, file, settings);
    let run = spec.run.clone();
    let prepared = Model::new(spec).unwrap();
    let start = prepared.start(&folder(example)).unwrap();
    let plan = RunPlan::of(&run, run.duration_s);
    let result = simulate(&prepared.kernel, &start, &plan).unwrap();
    (prepared.kernel, result)
}

/// Sets the velocity, m/s, of a point moved by one mode, in a physical state `(q, q', V)`.
pub fn set_velocity(system: &System, state: &mut [f64], point: &str, velocity_m_s: f64) {
    let n = system.modes.len();
    state[n + own_mode(system, point)] =
        velocity_m_s / system.modes.shape[point][own_mode(system, point)];
}

/// Returns the only mode that moves a point.
pub fn own_mode(system: &System, point: &str) -> usize {
    let shape = &system.modes.shape[point];
    let moving: Vec<usize> = (0..shape.len()).filter(|i| shape[*i] != 0.0).collect();
    assert_eq!(moving.len(), 1, "{point}: {shape:?}");
    moving[0]
}

/// Integrates from a physical state at time 0.
pub fn integrator<'k>(kernel: &'k Kernel, state: &[f64], tolerance: f64) -> Integrator<'k> {
    Integrator::new(
        kernel,
        &kernel.plant.from_physical(state, 0.0),
        0.0,
        tolerance,
    )
    .unwrap()
}

/// Displacement and velocity of a point at the end of an integration.
pub fn motion(integrator: &Integrator, kernel: &Kernel, point: &str) -> [f64; 2] {
    let state = kernel
        .plant
        .to_physical(&integrator.state(), integrator.time_s());
    let shape = &kernel.plant.system.modes.shape[point];
    let n = shape.len();
    [0, n].map(|from| shape.iter().zip(&state[from..]).map(|(s, q)| s * q).sum())
}

pub fn relative(value: f64, expected: f64) -> f64 {
    (value / expected - 1.0).abs()
}
