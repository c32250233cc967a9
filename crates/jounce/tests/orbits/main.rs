//! Periodic orbits and their branches against published numbers, closed forms and marches.
#![allow(clippy::unwrap_used, reason = "tests")]

mod paper;
