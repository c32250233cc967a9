//! Input of the questions: specs, starters, published examples and materials.

pub mod examples;
pub mod materials;
pub mod spec;
pub mod starters;
