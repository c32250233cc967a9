//! Periodic orbits and their branches against published numbers, closed forms and integrations, and
//! between methods.
#![allow(clippy::unwrap_used, reason = "tests")]

mod backbones;
mod balance;
mod basins;
mod bouncing_table;
mod carried;
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
mod rested;
#[path = "../linear/rows.rs"]
#[expect(dead_code, reason = "rows are checked one by one here")]
mod rows;
mod same_labels;
mod several;
mod square_root;
mod summed;
mod sweeps;
mod tracking;
mod widths;
