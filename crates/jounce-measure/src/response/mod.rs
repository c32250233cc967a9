//! Recordings of a hammer or shaker test, or of its response functions, to frequency responses with names and units; recordings without a
//! measured input to decays.
mod decays;
mod error;
mod excitation;
mod forces;
mod given;
mod prepared;
mod responses;

pub use decays::{AmbientSettings, Decays};
pub use error::ResponseError;
pub use excitation::Excitation;
pub use prepared::{Parts, bridged, paired};
pub use responses::{Chosen, Responses};
