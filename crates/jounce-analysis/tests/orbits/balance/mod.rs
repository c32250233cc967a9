//! Orbits by harmonic balance.

mod open_patch;
mod several_stops;
mod shooting;
