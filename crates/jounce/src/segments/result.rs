//! Result of the segmentation of a recording.

use jounce_data::recording::Issue;
use jounce_experiment::segmentation::{
    Candidate, MergedChange, RecordSegment, SegmentMatch, SegmentMatches, Segmentation,
};
use jounce_signal::spectral::MeanPower;
use serde::Serialize;

/// Segments of a recording, and the changes within one attractor.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SegmentsResult {
    /// Name of the channel.
    pub channel: String,
    /// Unit of the channel.
    pub unit: String,
    /// Frequency of the drive, Hz.
    pub drive_hz: f64,
    /// Resistance of the load, ohm.
    pub resistance_ohm: Option<f64>,
    /// Segments in order.
    pub segments: Vec<SegmentResult>,
    /// Changes of noise, drifts and disturbances, which are no changes of the attractor.
    pub joints: Vec<MergedChange>,
    /// Uncertainty of the time of a change, s.
    pub uncertainty_s: f64,
    /// Data-quality issues of the channel and of the times.
    pub issues: Vec<Issue>,
    /// Sampling rate, Hz.
    #[serde(skip)]
    pub rate_hz: f64,
    /// Time of each sample, s from the first sample.
    #[serde(skip)]
    pub time_s: Vec<f64>,
    /// Samples of the channel.
    #[serde(skip)]
    pub values: Vec<f64>,
    /// The segmentation that the figures show.
    #[serde(skip)]
    pub(super) segmentation: Segmentation,
}

/// Segment of a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SegmentResult {
    /// Begin, s from the first sample.
    pub start_s: f64,
    /// End, s from the first sample.
    pub end_s: f64,
    /// Rms about the mean, in the unit of the channel.
    pub rms: f64,
    /// Period in drive cycles; 0 where it is longer than 12 or absent.
    pub period_cycles: usize,
    /// Deviation from periodicity, relative to the rms.
    pub mismatch: f64,
    /// Mean power, W; `None` without a resistance, and where the segment is too short for an
    /// interval.
    pub mean_power_w: Option<f64>,
    /// Half width of the 95 % interval of the mean power, W.
    pub half_width_w: Option<f64>,
    /// Effective number of independent values of the power.
    pub effective_samples: Option<f64>,
    /// Correlation between consecutive batches of the power: near 0 for a valid interval.
    pub batch_correlation: Option<f64>,
    /// Mean voltage, V.
    pub mean_voltage_v: Option<f64>,
    /// True where the interval of the mean power may be too narrow.
    pub correlated: bool,
    /// Matching solution of the model, as in `1a`; `several` where more than one matches, `none`
    /// where no solution matches. `None` without a model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solution: Option<String>,
    /// Solutions of the model, the nearest first; empty without a model.
    pub candidates: Vec<Candidate>,
}

impl SegmentResult {
    pub(super) fn new(
        segment: &RecordSegment,
        power: Option<MeanPower>,
        matches: Option<&SegmentMatches>,
    ) -> Self {
        let solution = |matches: &SegmentMatches| match matches.fits {
            SegmentMatch::One => matches.id().unwrap_or_default().to_owned(),
            SegmentMatch::Several => "several".to_owned(),
            SegmentMatch::None => "none".to_owned(),
        };
        Self {
            start_s: segment.start_s,
            end_s: segment.end_s,
            rms: segment.rms,
            period_cycles: segment.period.cycles.unwrap_or(0),
            mismatch: segment.period.mismatch,
            mean_power_w: power.map(|power| power.mean_power_w),
            half_width_w: power.map(|power| power.half_width_w),
            effective_samples: power.map(|power| power.effective_samples),
            batch_correlation: power.map(|power| power.batch_correlation),
            mean_voltage_v: power.map(|power| power.mean_voltage_v),
            correlated: power.is_some_and(|power| power.correlated),
            solution: matches.map(solution),
            candidates: matches.map_or_else(Vec::new, |matches| matches.candidates.clone()),
        }
    }
}
