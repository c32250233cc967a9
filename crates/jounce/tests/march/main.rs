//! The marcher against exact answers, against itself under symmetries, and against published and tight reference runs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod collisions;
mod ensemble;
mod grazing;
mod harvester;
mod plants;
mod random;
mod rigid;
mod signals;
mod swings;
mod symmetry;
mod variation;
mod work;
