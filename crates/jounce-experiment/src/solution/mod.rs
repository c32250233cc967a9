//! Solutions of a model that a record can show: the attractors reached from a cloud of starts, each
//! with an initial state and the waveform of a voltage.
//!
//! A waveform is the Fourier series over one period of `n` drive cycles,
//!
//! ```text
//! v(t) = sum_k Re(c_k exp(2 pi i k f t / n)),   c_k in V, peak;   k / n is the order of the line
//! ```
//!
//! from uniform samples of the exact solution over the period, without the mean.
mod error;
mod find;
mod output;
mod recorded;
mod waveform;

pub use error::SolutionError;
pub use find::{Solution, SolutionSearch, solutions};
pub use output::{SensorOutput, outputs};
pub use recorded::{as_recorded, start_of};
pub use waveform::{MAX_ORDER, Waveform};
