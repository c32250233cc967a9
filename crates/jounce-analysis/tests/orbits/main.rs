//! Periodic orbits and their branches against published numbers, closed forms and integrations, and
//! between methods.
#![allow(clippy::unwrap_used, reason = "tests")]

mod backbones;
mod balance;
mod basins;
mod bouncing_table;
mod branch_update;
mod closed_forms;
mod diagrams;
mod duffing;
mod events;
mod hard_cases;
mod harvesters;
mod isolated;
mod labels;
mod levels;
mod open_patch;
mod oscillators;
mod paper;
mod peaks;
mod planes;
mod recognition;
mod rectified;
#[path = "../linear/rows.rs"]
#[expect(dead_code, reason = "rows are checked one by one here")]
mod rows;
mod same_labels;
mod several_frequencies;
mod several_stops;
mod square_root;
mod sticking_orbits;
mod sweeps;
mod tracking;
mod widths;
