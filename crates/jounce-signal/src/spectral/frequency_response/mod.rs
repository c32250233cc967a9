//! Frequency responses of hammer and shaker tests.
mod averages;
mod hit_blocks;
mod hit_warning;
mod hits;
mod impact;
mod impact_test;
#[cfg(test)]
mod oscillator;
mod pre_trigger_check;
mod response;
mod shaker;
mod sweep;
mod taper;
mod window_bias;

pub use averages::SpectrumAverages;
pub use hit_warning::HitWarning;
pub use hits::{Hit, HitSearch, hits};
pub use impact::impact;
pub use impact_test::{ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings};
pub use response::{Estimator, FrequencyResponse, LeaveOneOutResponse};
pub use shaker::is_continuous;
pub use taper::{exponential_window, force_window};
pub use window_bias::WindowBias;
