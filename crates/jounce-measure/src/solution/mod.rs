//! The solutions of a model that a record can show: the attractors that a cloud of starts finds, each as a start to march from and as the
//! waveform of a voltage.
//!
//! A waveform is the Fourier series over one period of `n` drive cycles,
//!
//! ```text
//! v(t) = sum_k Re(c_k exp(2 pi i k f t / n)),   c_k in V, peak;   k / n is the order of the line
//! ```
//!
//! from an even number of samples of the exact march over the period; the mean is left out.
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
