//! Recordings to frequency responses, modes and contact laws, without a model of the structure.
//!
//! [`response`] turns hammer and shaker tests into frequency responses or free decays, [`modal`]
//! these into modes with their uncertainty, [`contact`] the pulses of a force into contact time,
//! exponent, stiffness and restitution.

pub mod contact;
pub mod modal;
pub mod response;
