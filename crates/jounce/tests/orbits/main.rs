//! Periodic orbits and their branches against published numbers, closed forms, marches, and one method against the other.
#![allow(clippy::unwrap_used, reason = "tests")]

mod balance;
mod closed_forms;
mod harvesters;
mod paper;
mod sweeps;
