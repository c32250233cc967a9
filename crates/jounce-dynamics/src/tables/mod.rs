//! Step lengths, and the tables of a step of one length, shared by all runs of a plant.

pub(crate) mod contact;
mod cross;
pub(crate) mod joint;
pub(crate) mod odd_tables;
pub(crate) mod step_size;
pub(crate) mod step_tables;
