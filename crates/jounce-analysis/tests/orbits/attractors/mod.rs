//! Attractors, their shares and their diagrams.

mod basins;
mod diagrams;
mod recognition;
