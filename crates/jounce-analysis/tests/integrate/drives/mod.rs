//! Drives other than sinusoids, random responses and initial velocities.

mod ensemble;
mod gravity;
mod initial_velocities;
mod oscillator;
mod recordings;
mod signals;
