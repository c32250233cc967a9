//! Analysis of laboratory recordings: powers, spectra, frequency responses, modes, contacts,
//! segments.
//!
//! A file becomes a [`recording::Recording`]: channels in SI units with names, locations and
//! directions, and data-quality issues. The analyses accept recordings or plain numbers and are
//! independent of file formats.
//!
//! ARCHITECTURE.md lists the layers of this crate; a folder uses only those listed before it.

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
