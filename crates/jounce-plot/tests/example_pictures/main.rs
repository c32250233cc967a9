//! Pictures of the examples that no command draws: computed from their specs and compared with the
//! stored files.
//!
//! `JOUNCE_DRAW=1 cargo test --test example_pictures` draws them again.
#![allow(clippy::unwrap_used, reason = "tests")]

mod comparison;
#[path = "../../../jounce-analysis/tests/linear/example.rs"]
mod example;
mod loads;
mod noise;
mod oscillators;
mod patches;
mod rectified;
mod responses;
#[path = "../../../jounce-analysis/tests/linear/rows.rs"]
#[expect(dead_code, reason = "of the rows only the folder is used here")]
mod rows;
