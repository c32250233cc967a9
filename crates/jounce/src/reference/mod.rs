//! Exact answers: small problems whose solution is known in closed form, each with the system that jounce solves for it.
//!
//! A problem is one type in one file. Its fields are its parameters in SI units; `system` gives the [`crate::plant::System`] to
//! solve (where jounce can be asked the question), the other methods give the exact answer. [`Reference::SOURCE`] says where
//! the answer comes from, [`Reference::TOLERANCE`] how closely a correct solver must meet it.

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

/// Where an exact answer comes from and how closely it must be met.
pub trait Reference {
    /// Source of the closed form.
    const SOURCE: &'static str;
    /// Largest relative error of a correct solver that works at its tightest tolerance.
    const TOLERANCE: f64;
}
