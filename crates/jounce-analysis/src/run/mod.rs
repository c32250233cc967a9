//! One run: time integration from an initial state, with averages, energy balance and a
//! steady-state test.

mod charge;
mod device;
mod error;
mod limits;
mod model_limits;
mod plan;
mod result;
mod settle;
mod simulate;
mod start;
mod voltage_peak;
mod warning;

pub use charge::{ChargeResult, charges};
pub use device::{DeviceResult, WorstOperation};
pub use error::RunError;
pub(crate) use error::check_outside;
pub use limits::{ExceededLimit, LimitedQuantity, Limits, WorstExcess, exceeded};
pub use plan::RunPlan;
pub use result::{LeakResult, LoadResult, RectifiedResult, RunResult, StopResult};
pub use settle::Settlement;
pub use simulate::simulate;
pub use start::{StartFileError, StartState};
pub use voltage_peak::{VoltagePeaks, voltage_peaks};
pub use warning::Warning;
