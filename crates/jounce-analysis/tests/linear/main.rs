//! Linear responses: base motion, circuits and noise, against closed forms and the expected numbers
//! of `examples/`.
#![allow(clippy::unwrap_used, reason = "tests")]

mod adhikari;
mod bilgen;
mod circuits;
mod de_marqui;
mod erturk_2008;
mod erturk_2009;
mod example;
mod expected;
mod martinez_ayuso;
mod noise;
mod rows;
