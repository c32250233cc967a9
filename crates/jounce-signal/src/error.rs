//! Errors of signals.

/// Invalid signal, or invalid request for a signal.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum SignalError {
    /// The signal has no samples.
    #[error("the signal has no samples; a longer record is needed")]
    Empty,
    /// The sample rate is zero, negative or not a number.
    #[error("the sample rate is {rate_hz} Hz; it must be a finite number > 0")]
    Rate {
        /// Sample rate, Hz.
        rate_hz: f64,
    },
    /// A sample is NaN or infinite.
    #[error("sample {index} of the signal is {value}; all samples must be finite")]
    Sample {
        /// Index of the sample, from 0.
        index: usize,
        /// Value of the sample.
        value: f64,
    },
    /// An order line lies at zero, beyond the Nyquist frequency, or is duplicate.
    #[error(
        "order {order} of {drive_hz} Hz cannot be fitted: every order must lie above 0 and below {nyquist_hz} Hz, and be asked for once"
    )]
    Order {
        /// The order.
        order: f64,
        /// The drive frequency, Hz.
        drive_hz: f64,
        /// Half the sample rate, Hz.
        nyquist_hz: f64,
    },
    /// The record is too short to resolve the lines.
    #[error(
        "the record lasts {duration_s} s; to resolve these orders it must last at least {needed_s} s"
    )]
    Short {
        /// Length of the record, s.
        duration_s: f64,
        /// Period of the smallest spacing of the lines, s.
        needed_s: f64,
    },
}
