//! The integrator against closed forms, symmetries, and published and tight reference runs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod cancellation;
mod collisions;
mod conduction_states;
mod contacts;
mod cradle;
mod ensemble;
mod friction;
mod grazing;
mod harvester;
mod initial_velocities;
mod instants;
mod leaks;
mod plants;
mod ports;
mod random;
mod rectified;
mod rigid;
mod sensitivity;
mod signals;
mod sticking;
mod stiff;
mod swings;
mod symmetry;
mod time_integral;
mod voltage_peak;
mod work;
