//! One run: time integration from an initial state, with averages, energy balance and a
//! steady-state test.

mod charge;
mod device;
mod error;
mod extremes;
mod ineffective;
mod limits;
mod model_limits;
mod model_warnings;
mod output_peak;
mod output_row;
mod plan;
mod polarity;
mod result;
mod settle;
mod simulate;
mod start;
mod subject;
mod warning;

pub use charge::{ChargeResult, charges};
pub use device::{DeviceResult, WorstOperation};
pub use error::RunError;
pub(crate) use error::check_outside;
pub use limits::{ExceededLimit, Limits, PatchQuantity, WorstExcess};
pub use output_peak::{OutputPeaks, output_peaks};
pub use plan::RunPlan;
pub use result::{LeakResult, LoadResult, RectifiedResult, RunResult, StopResult};
pub use settle::Settlement;
pub use simulate::simulate;
pub use start::{StartFileError, StartState, identity_text};
pub use warning::{MAX_DEFLECTION_SHARE, Warning};
