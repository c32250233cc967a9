//! Helpers shared by several tests.

use jounce_dynamics::{Integrator, Kernel};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes;
use jounce_spec::Spec;

pub fn kernel(text: &str) -> Kernel {
    let spec = Spec::from_toml(text).unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    let system = System::assemble(&spec, modes(&spec).unwrap()).unwrap();
    Kernel::new(Plant::new(system).unwrap()).unwrap()
}

/// Integrates from displacements and velocities of all modes.
pub fn integrator<'k>(
    kernel: &'k Kernel,
    displacement: &[f64],
    velocity: &[f64],
    tolerance: f64,
) -> Integrator<'k> {
    let mut x: Vec<f64> = displacement.iter().chain(velocity).copied().collect();
    x.resize(kernel.plant.len(), 0.0);
    Integrator::new(kernel, &kernel.plant.from_physical(&x, 0.0), 0.0, tolerance).unwrap()
}

/// Displacement and velocity of a point.
pub fn motion(integrator: &Integrator, kernel: &Kernel, point: &str) -> [f64; 2] {
    let (x, n) = (integrator.physical(), kernel.plant.system.modes.len());
    let shape = &kernel.plant.system.modes.shape[point];
    [0, n].map(|first| shape.iter().zip(&x[first..]).map(|(s, q)| s * q).sum())
}

/// Contact laws of all kinds for a mass of 1 kg; all except the first dissipate energy.
pub const LAWS: [&str; 5] = [
    "law = \"hertz\"\nstiffness = \"3e6 N/m^1.5\"",
    "law = \"spring\"\nstiffness = \"20 kN/m\"",
    "law = \"kelvin-voigt\"\nstiffness = \"20 kN/m\"\ndamping = \"15 N s/m\"",
    "law = \"hunt-crossley\"\nstiffness = \"3e6 N/m^1.5\"\ndamping = \"0.4 s/m\"",
    "law = \"rigid\"\nrestitution = 0.7",
];
