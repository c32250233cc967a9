//! Frequency responses of hammer and shaker tests.
mod hits;
mod impact;
mod pre_trigger_check;
mod response;
mod shaker;
mod taper;
mod window_bias;

pub use hits::{Hit, HitSearch, HitWarning, hits};
pub use impact::{ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings, impact};
pub use response::{Estimator, FrequencyResponse, LeaveOneOutResponse, SpectrumAverages};
pub use shaker::is_continuous;
pub use taper::{exponential_window, force_window};
pub use window_bias::WindowBias;
