//! Oscillators whose orbits are known: bouncing balls, impact oscillators, Duffing.

mod backbones;
mod bouncing_table;
mod derivatives;
mod duffing;
mod duffing_equation;
mod interfaces;
mod multipliers;
mod oscillators;
mod random_derivatives;
mod several_frequencies;
mod square_root;
mod sticking_orbits;
