//! Exact solutions: small problems with a closed-form solution, each with the system that jounce
//! solves for it.
//!
//! Each problem is one type in one file. Its fields are its parameters in SI units. `system` gives
//! the [`crate::plant::System`] to solve, where jounce can solve it; the other methods give the
//! exact solution. [`Reference::SOURCE`] gives the source of the solution, [`Reference::TOLERANCE`]
//! the largest error of a correct solver.

mod bilinear;
mod bouncing_ball;
mod bouncing_table;
mod cantilever;
mod duffing;
mod harmonic;
mod hertz_collision;
mod hunt_crossley_collision;
mod impact_oscillator;
mod impulse;
mod kelvin_voigt_collision;
mod piezo_resistor;
mod root;
mod single_mode;

pub use bilinear::Bilinear;
pub use bouncing_ball::BouncingBall;
pub use bouncing_table::{BouncingTable, TableOrbit};
pub use cantilever::Cantilever;
pub use duffing::Duffing;
pub use harmonic::Harmonic;
pub use hertz_collision::HertzCollision;
pub use hunt_crossley_collision::HuntCrossleyCollision;
pub use impact_oscillator::{ImpactOrbit, ImpactOscillator};
pub use impulse::Impulse;
pub use kelvin_voigt_collision::KelvinVoigtCollision;
pub use piezo_resistor::PiezoResistor;
pub use single_mode::{MASS, PATCH};

/// Source and tolerance of an exact solution.
pub trait Reference {
    /// Source of the closed form.
    const SOURCE: &'static str;
    /// Largest relative error of a correct solver at its tightest tolerance.
    const TOLERANCE: f64;
}
