//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! Data flows in one direction; a module uses only the modules before it in this list:
//!
//! `store` (atomic file writes), `simd` (vector arithmetic), `material` (material data), `spec` (the
//! user's specification) -> `starter` (specs to start from) -> `structure` (beams and masses to
//! modes) -> `contact` (laws) -> `drive` (time histories of drives) -> `plant` (the coupled linear
//! system in diagonal form, with its ports) -> `linear` (closed-form responses) -> `integrate`
//! (integration in time) -> `continuation` (curves of solutions) -> `orbit` (periodic orbits) ->
//! `run` -> `signal` -> `analysis` (sweeps, branches, basins) -> `table` -> `study` (parametric
//! studies) -> `picture` -> `show` (drawings) -> `report` -> `reproduce` (the paper);
//! `reference` holds exact solutions.

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
