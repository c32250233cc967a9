//! Contact force on a step and the exact response of the blocks and of the output rows to it.

pub(crate) mod basis;
mod driven_response;
pub(crate) mod duhamel;
pub(crate) mod factors;
pub mod fast_decay;
pub(crate) mod output_rows;
pub(crate) mod step_response;
