//! What cannot be asked of a spectrum.

use jounce::signal::SignalError;

/// A question that the samples cannot answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum SpectralError {
    /// The samples are no signal.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A channel that never moves.
    #[error(
        "all {samples} samples of {channel} are {value}: there is no signal; is it the right channel, and was its sensor connected?"
    )]
    Constant {
        /// The channel.
        channel: String,
        /// Its samples.
        samples: usize,
        /// What they all are.
        value: f64,
    },
    /// A segment that does not fit.
    #[error(
        "segments of {segment} samples cannot be cut from {samples}; give a length of 8 to {samples} samples"
    )]
    Segment {
        /// Length asked for.
        segment: usize,
        /// Length of the record.
        samples: usize,
    },
    /// Fewer samples than a segment has at least.
    #[error(
        "{samples} samples are too few for a spectrum: a segment, and so the record, has 8 samples at least"
    )]
    Few {
        /// Samples of the segment, or of the record.
        samples: usize,
    },
    /// An overlap outside its range.
    #[error("an overlap of {overlap} makes no sense; give a share of the segment from 0 to 0.95")]
    Overlap {
        /// What was asked for.
        overlap: f64,
    },
    /// Two signals of unequal length.
    #[error("the force has {force} samples and the response {response}; they must be equally long")]
    Lengths {
        /// Samples of the input.
        force: usize,
        /// Samples of the output.
        response: usize,
    },
    /// Records of unequal rate.
    #[error(
        "one record was sampled at {first_hz} Hz and another at {other_hz} Hz; all must have one rate"
    )]
    Rates {
        /// Rate of the first, Hz.
        first_hz: f64,
        /// Rate of the other, Hz.
        other_hz: f64,
    },
    /// Nothing was averaged.
    #[error("no block was averaged; at least one is needed, two for a coherence")]
    Nothing,
    /// A record without a hit.
    #[error(
        "no hit: the largest force is {largest_n:.4} N against a noise of {noise_n:.4} N; is this the channel of the hammer?"
    )]
    NoHit {
        /// Largest sample, N.
        largest_n: f64,
        /// Noise of the record, N.
        noise_n: f64,
    },
    /// A window of hits on a force that goes on.
    #[error(
        "the force goes on, as a shaker's does: a force window or an exponential window belongs to hits; leave them away, a block is weighed by a \
         Hann window"
    )]
    HitWindow,
    /// A record too short for an interval.
    #[error(
        "{samples} samples are too few for a mean with an interval; at least {needed} are needed"
    )]
    Short {
        /// Samples of the record.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// Stopped by its control.
    #[error("stopped")]
    Stopped,
}
