//! Periodic orbits and their branches against published numbers, closed forms, marches, and one method against the other.
#![allow(clippy::unwrap_used, reason = "tests")]

mod balance;
mod basins;
mod closed_forms;
mod diagrams;
mod hard_cases;
mod harvesters;
mod isolated;
mod paper;
mod peaks;
mod sweeps;
mod tracking;
mod widths;
