//! Random answers: many marches under seeded noise, and what they say of the mean.

mod estimate;
mod member;
mod search;

pub use estimate::{Estimate, IntervalOver};
pub use member::Member;
pub use search::{Ensemble, EnsembleAnswer};
