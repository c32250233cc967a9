//! Recordings of a hammer test, or of its response functions, to frequency responses with names and units.
mod error;
mod responses;

pub use error::ResponseError;
pub use responses::{Chosen, Responses};
