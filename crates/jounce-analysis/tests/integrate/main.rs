//! The integrator against closed forms, symmetries, and published and tight reference runs.
#![allow(clippy::unwrap_used, reason = "tests")]

mod cancellation;
mod circuits;
mod contacts;
mod drives;
mod harvester;
mod plants;
mod random;
mod runge_kutta;
mod sensitivity;
mod symmetry;
mod time_integral;
mod work;
