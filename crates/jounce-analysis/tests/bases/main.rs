//! Bases in relative motion: a system written in two frames has one motion, and closed forms hold.
#![allow(clippy::unwrap_used, reason = "tests")]

mod courses;
mod faults;
mod frames;
mod orbits;
mod systems;
mod transmissibility;
