//! Computes frequency responses with names and units from recordings of hammer or shaker tests, or
//! imports them; computes decays from recordings without a measured input.
mod complex_columns;
mod correlation;
mod decays;
mod error;
mod excitation;
mod forces;
mod imported_functions;
mod reference_analysis;
mod responses;

pub use complex_columns::{ComplexParts, bridged, paired};
pub use decays::{AmbientSettings, Decays};
pub use error::ResponseError;
pub use excitation::Excitation;
pub use responses::{ChannelChoice, MeasuredResponses};
