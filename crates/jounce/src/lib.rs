//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! Data flows one way, and a module uses only what stands before it in this list:
//!
//! `spec` (what the user says) -> `structure` (beams and masses to modes) -> `contact` (laws) -> `plant` (the coupled
//! linear system in diagonal form, with its ports) -> `linear` (closed-form answers) -> `march` (time) -> `response` ->
//! `signal` -> `measure` -> `study` (sweeps) -> `table` -> `picture` -> `report`; `reference` holds exact answers.

pub mod spec;
pub mod contact;
pub mod march;
pub mod plant;
pub mod structure;

/// The Rust code of the README, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}
