//! Result of a virtual test.

use crate::recording::Recording;
use jounce_data::recording::Issue;
use serde::Serialize;

/// Recording of a virtual test.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RigResult {
    /// Number of samples of each channel.
    pub samples: usize,
    /// Sampling rate, Hz.
    pub rate_hz: f64,
    /// Names of the channels.
    pub channels: Vec<String>,
    /// Seed of hits, fluctuation and noise.
    pub seed: u64,
    /// Data-quality issues of the recording.
    pub issues: Vec<Issue>,
    /// The recording.
    #[serde(skip)]
    pub recording: Recording,
    /// The recorded motion of the base; `None` in other tests.
    #[serde(skip)]
    pub base: Option<BaseMotion>,
}

/// Recorded motion of the base.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BaseMotion {
    /// Name of the recording.
    pub recording: String,
    /// Name of its channel.
    pub channel: String,
    /// Mean of the channel, m/s^2.
    pub mean_m_s2: f64,
    /// True where the mean is retained, false where it is subtracted.
    pub is_mean_kept: bool,
    /// Data-quality issues of the channel and of the times.
    pub issues: Vec<Issue>,
}

impl RigResult {
    pub(super) fn new(recording: Recording, base: Option<BaseMotion>, seed: u64) -> Self {
        Self {
            samples: recording.samples(),
            rate_hz: recording.rate(),
            channels: recording.channel_names(),
            seed,
            issues: recording.issues().to_vec(),
            recording,
            base,
        }
    }
}
