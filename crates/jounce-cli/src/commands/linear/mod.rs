//! Commands on the harvester without contact.

pub mod frf;
pub mod modes;
pub mod noise;
