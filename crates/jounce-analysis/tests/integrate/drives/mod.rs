//! Drives other than sinusoids, random responses and initial velocities.

mod ensemble;
mod initial_velocities;
mod signals;
