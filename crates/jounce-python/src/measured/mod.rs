//! What a test rig has recorded: arrays to recordings of `jounce-measure`, and its answers to arrays.

pub mod contact;
pub mod decays;
pub mod hammer;
pub mod modes;
pub mod power;
pub mod recording;
pub mod segments;
pub mod spectra;
