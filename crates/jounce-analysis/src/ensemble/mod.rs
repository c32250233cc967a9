//! Random responses: many integrations under seeded noise, with estimates of their means.

mod contacts;
mod devices;
mod estimate;
mod member;
mod search;
mod spectrum;

pub use contacts::{ContactCount, MemberStop, StopEstimates};
pub use devices::{DeviceCount, DeviceEstimates, MemberDevice};
pub use estimate::{Estimate, IntervalOver};
pub use member::Member;
pub use search::{Ensemble, EnsembleResult};
pub use spectrum::VoltageSpectrum;
