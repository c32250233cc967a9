//! Periodic orbits and their branches against published numbers, closed forms and integrations, and
//! between methods.
#![allow(clippy::unwrap_used, reason = "tests")]

mod attractors;
mod balance;
mod branches;
mod closed_forms;
mod harvesters;
mod rectified;
#[path = "../linear/rows.rs"]
#[expect(dead_code, reason = "rows are checked one by one here")]
mod rows;
mod two_parameters;

use jounce_allocator as _;
