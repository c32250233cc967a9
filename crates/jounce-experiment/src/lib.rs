//! Recordings compared with a model of the harvester.
//!
//! [`rig`] simulates the sensors of a test, [`solution`] finds the attractors of a model that a
//! recording can show, [`segmentation`] cuts a long recording into parts of one attractor each,
//! and [`fit`] fits keys of a spec to measurements. [`draw`] draws the figures of recordings.

pub mod draw;
pub mod fit;
pub mod rig;
pub mod segmentation;
pub mod solution;
