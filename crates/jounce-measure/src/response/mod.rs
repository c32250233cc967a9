//! Recordings of a hammer test, or of its response functions, to frequency responses with names and units; recordings without a measured force
//! to decays.
mod decays;
mod error;
mod forces;
mod given;
mod responses;

pub use decays::{AmbientSettings, Decays};
pub use error::ResponseError;
pub use responses::{Chosen, Responses};
