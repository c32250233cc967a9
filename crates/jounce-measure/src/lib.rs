//! From a laboratory's recordings to answers: powers, spectra, frequency responses, modes, contacts, regimes.
//!
//! A file becomes a [`recording::Recording`]: channels in SI units with names, places and directions, and everything that is odd about them as
//! findings. What follows takes recordings or plain numbers and knows nothing of files.
//!
//! The layers of this crate stand in ARCHITECTURE.md; a folder uses only what stands before it there.

pub use jounce_data::{read, recording};

pub mod contact;
pub mod draw;
pub mod experiment;
pub mod fit;
pub mod modal;
pub mod response;
pub mod rig;
pub mod segmentation;
pub mod solution;
pub mod spectral;
pub mod write;
