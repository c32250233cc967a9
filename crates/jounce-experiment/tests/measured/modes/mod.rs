//! Modes identified from recordings.

mod base_input;
mod cantilever;
mod close_modes;
mod fourier;
mod hammer;
mod intervals;
mod references;
mod seven_modes;
mod standard_test;
mod unknown_noise;
