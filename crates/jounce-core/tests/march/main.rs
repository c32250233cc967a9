//! The integrator against closed forms, symmetries, and published and tight reference runs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod collisions;
mod contacts;
mod cradle;
mod ensemble;
mod flux;
mod friction;
mod grazing;
mod harvester;
mod instants;
mod leaks;
mod plants;
mod ports;
mod random;
mod rectified;
mod regimes;
mod rest;
mod rigid;
mod signals;
mod stiff;
mod swings;
mod symmetry;
mod thrown;
mod variation;
mod visits;
mod voltage_peak;
mod work;
