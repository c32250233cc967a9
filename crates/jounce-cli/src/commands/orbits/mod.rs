//! Commands on periodic orbits and attractors.

pub mod basins;
pub mod bifurcations;
pub mod branch;
pub mod diagram;
pub mod sensitivity;
