//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! Data flows one way, and a module uses only what stands before it in this list:
//!
//! `store` (files that appear whole or not at all), `wide` (vector arithmetic), `spec` (what the user says) -> `starter` (specs to start from) -> `structure` (beams and masses to modes) ->
//! `contact` (laws) -> `drive` (courses of drives in time) -> `plant` (the coupled linear system in diagonal form, with its ports) -> `linear` (closed-form answers) ->
//! `march` (time) -> `continuation` (curves of solutions) -> `orbit` (periodic answers) -> `run` -> `signal` -> `study` (sweeps) -> `table` -> `survey` (studies in parts) -> `picture` -> `show` (drawings) -> `report` -> `reproduce` (the paper);
//! `reference` holds exact answers.

pub mod analysis;
pub mod contact;
pub mod continuation;
pub mod drive;
pub mod integrate;
pub mod linear;
pub mod material;
pub mod orbit;
pub mod picture;
pub mod plant;
pub mod reference;
pub mod report;
pub mod reproduce;
pub mod run;
pub mod show;
pub mod signal;
pub mod simd;
pub mod spec;
pub mod starter;
pub mod store;
pub mod structure;
pub mod study;
pub mod table;

/// The Rust code of the README, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}
