//! Step lengths, and the tables of a step of one length, shared by all runs of a plant.

pub(crate) mod ad_hoc;
pub(crate) mod cache;
pub(crate) mod contact;
mod cross;
pub(crate) mod joint;
pub(crate) mod step_size;
