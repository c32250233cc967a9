//! Bases that move against each other: the same system written in two frames moves in the same way, and closed forms hold.
#![allow(clippy::unwrap_used, reason = "tests")]

mod courses;
mod frames;
mod orbits;
mod refused;
mod systems;
mod transmissibility;
