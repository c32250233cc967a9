//! Commands that read or write recordings.

pub mod contact;
pub mod fit;
pub mod measured_frf;
pub mod measured_modes;
pub mod power;
pub mod read;
pub mod rig;
pub mod segments;
pub mod spectra;
