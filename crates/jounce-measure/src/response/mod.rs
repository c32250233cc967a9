//! Recordings of a hammer or shaker test, or of its response functions, to frequency responses with names and units; recordings without a
//! measured input to decays.
mod complex_columns;
mod decays;
mod error;
mod excitation;
mod forces;
mod imported_functions;
mod responses;

pub use complex_columns::{ComplexParts, bridged, paired};
pub use decays::{AmbientSettings, Decays};
pub use error::ResponseError;
pub use excitation::Excitation;
pub use responses::{ChannelChoice, MeasuredResponses};
