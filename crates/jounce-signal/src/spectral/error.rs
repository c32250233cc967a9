//! Errors of spectral analysis.

use crate::SignalError;

/// Error of a spectral analysis.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum SpectralError {
    /// The samples are not a valid signal.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A channel is constant.
    #[error(
        "all {samples} samples of {channel} are {value}: there is no signal; is it the right channel, and was its sensor connected?"
    )]
    Constant {
        /// The channel.
        channel: String,
        /// Number of its samples.
        samples: usize,
        /// Value of all samples.
        value: f64,
    },
    /// The square of a sample is larger than the largest number.
    #[error(
        "sample {sample} of {channel} is {value:e}, and its square is too large for a number; is the unit right?"
    )]
    Overflow {
        /// The channel.
        channel: String,
        /// Index of the first such sample.
        sample: usize,
        /// Its value.
        value: f64,
    },
    /// A segment does not fit into the record.
    #[error(
        "segments of {segment} samples cannot be cut from {samples}; give a length of 8 to {samples} samples"
    )]
    Segment {
        /// Requested length.
        segment: usize,
        /// Length of the record.
        samples: usize,
    },
    /// There are fewer samples than the minimum of a segment.
    #[error(
        "a segment of {samples} samples is too short for a spectrum; it needs at least 8 samples: use a longer record"
    )]
    Few {
        /// Samples of the segment, or of the record.
        samples: usize,
    },
    /// The overlap is out of range.
    #[error("the overlap is {overlap}; give a share of the segment from 0 to 0.95")]
    Overlap {
        /// Requested overlap.
        overlap: f64,
    },
    /// Two signals have unequal lengths.
    #[error("the force has {force} samples and the response {response}; they must be equally long")]
    Lengths {
        /// Samples of the input.
        force: usize,
        /// Samples of the output.
        response: usize,
    },
    /// Records have unequal rates.
    #[error(
        "one record was sampled at {first_hz} Hz and another at {other_hz} Hz; all must have one rate"
    )]
    Rates {
        /// Rate of the first, Hz.
        first_hz: f64,
        /// Rate of the other, Hz.
        other_hz: f64,
    },
    /// No block was averaged.
    #[error("no block was averaged; at least one is needed, two for a coherence")]
    Nothing,
    /// The record contains no hit.
    #[error(
        "no hit: the largest force is {largest_n:.4} N against a noise of {noise_n:.4} N; is this the channel of the hammer?"
    )]
    NoHit {
        /// Largest sample, N.
        largest_n: f64,
        /// Noise of the record, N.
        noise_n: f64,
    },
    /// A window for hits was requested for a continuous force.
    #[error(
        "the force is continuous, as a shaker's: a force window or an exponential window is for \
        hits; omit them, a block has a Hann window"
    )]
    HitWindow,
    /// The record is too short for an interval.
    #[error(
        "{samples} samples are too few for a mean with an interval; at least {needed} are needed"
    )]
    Short {
        /// Samples of the record.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// Cancelled.
    #[error("stopped")]
    Stopped,
}
