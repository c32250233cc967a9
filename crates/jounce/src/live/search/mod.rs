//! Search for a better design on a page, and the band of the power under tolerances.

mod band;
mod fields;
mod found;
mod problem;

pub use band::{BandOptions, BandResult};
pub use fields::{DesignFields, FieldFault};
pub use found::{BetterDesign, FoundDesign};
pub use problem::{DesignGoal, DesignOffer};
