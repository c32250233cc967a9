//! Segments of a record.

use jounce_control::Control;
use jounce_linalg::c64;
use jounce_signal::{Samples, SignalError};
use serde::Serialize;

use super::RepetitionPeriod;
use super::features::{CYCLES_PER_BLOCK, block_features};
use super::merging::{MergeReason, MergedChange, drifts, lines, merge_segments};
use super::partition::{change_points, noise};
use super::period::period_watched;

/// Segment of one solution.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordSegment {
    /// Start, s from the first sample.
    pub start_s: f64,
    /// End, s.
    pub end_s: f64,
    /// First sample.
    pub start: usize,
    /// Sample after the last.
    pub end: usize,
    /// Samples without the blocks next to a change, which may contain both solutions.
    #[serde(skip)]
    pub inner: (usize, usize),
    /// RMS about the mean, in the unit of the record, computed without the blocks next to a change.
    pub rms: f64,
    /// Period, computed without the blocks next to a change.
    pub period: RepetitionPeriod,
}

/// Segments of a record, with their uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Segmentation {
    /// Segments in order.
    pub segments: Vec<RecordSegment>,
    /// Changes of noise, drifts and glitches, which are not changes of solution.
    pub joints: Vec<MergedChange>,
    /// Maximum error of the time of a change, s: the length of a block.
    pub uncertainty_s: f64,
}

/// Error of a segmentation.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum SegmentationError {
    /// The samples are not a valid signal.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// The drive frequency is out of range.
    #[error(
        "a drive of {drive_hz} Hz is not suitable for a record of {rate_hz} Hz; it must be above \
        0 and below a quarter of the rate"
    )]
    Drive {
        /// Drive frequency, Hz.
        drive_hz: f64,
        /// Sampling rate, Hz.
        rate_hz: f64,
    },
    /// The record has too few cycles.
    #[error(
        "the record has {cycles:.1} drive cycles; at least {needed} are needed to distinguish \
        solutions"
    )]
    Short {
        /// Cycles of the record.
        cycles: f64,
        /// Cycles needed.
        needed: f64,
    },
    /// All samples are equal.
    #[error("all samples are equal: there is no signal to segment")]
    Constant,
    /// Cancelled.
    #[error("stopped")]
    Stopped,
}

/// Minimum number of blocks of a record.
const MIN_RECORD_BLOCKS: f64 = 4.0;
/// Minimum size of a change relative to the record's largest feature.
const MIN_CHANGE_SHARE: f64 = 0.05;
/// Cost of a segment, times the logarithm of the number of blocks, for each feature: its mean, its
/// trend and its deviation.
const SEGMENT_COST: f64 = 3.0;

/// Segments a record under a drive of known frequency.
///
/// # Errors
/// A drive that is not suitable for the sampling rate, a record of fewer than 24 cycles, a constant
/// record.
pub fn segments(samples: &Samples<'_>, drive_hz: f64) -> Result<Segmentation, SegmentationError> {
    segments_watched(samples, drive_hz, &Control::default())
}

/// Segments a record as [`segments`] does, with a cancellation check for each block, each end of a
/// piece and each tested period.
///
/// # Errors
/// Those of [`segments`], and [`SegmentationError::Stopped`].
pub fn segments_watched(
    samples: &Samples<'_>,
    drive_hz: f64,
    control: &Control,
) -> Result<Segmentation, SegmentationError> {
    let blocks = Blocks::of(samples, drive_hz)?;
    let features = blocks.features(samples, drive_hz, control)?;
    let largest_feature = features.iter().flatten().copied().fold(0.0, f64::max);
    if largest_feature <= 0.0 {
        return Err(SegmentationError::Constant);
    }
    // A clean record has hardly any noise: the size of a change then decides.
    let ln_count = (blocks.count as f64).ln();
    let floor = MIN_CHANGE_SHARE * largest_feature / (4.0 * ln_count).sqrt();
    let noise: Vec<f64> = noise(&features).into_iter().map(|s| s.max(floor)).collect();
    let cost = SEGMENT_COST * noise.len() as f64 * ln_count;
    let starts =
        change_points(&features, &noise, cost, control).ok_or(SegmentationError::Stopped)?;
    let lines = lines(samples, drive_hz, (blocks.count, blocks.length));
    let (starts, mut joints) = merge_segments(samples, drive_hz, starts, (&lines, blocks.length));
    let segments = (0..starts.len())
        .map(|k| {
            let (bounds, inner) = blocks.sample_ranges(&starts, k, samples.values().len());
            record_segment(samples, drive_hz, bounds, inner, control)
        })
        .collect::<Result<Vec<RecordSegment>, _>>()?;
    joints.extend(unreported_drifts(&segments, &starts, &lines, &joints));
    joints.sort_by(|a, b| a.at_s.total_cmp(&b.at_s));
    Ok(Segmentation {
        segments,
        joints,
        uncertainty_s: blocks.length / samples.rate_hz(),
    })
}

/// Division of a record into blocks of some drive cycles.
struct Blocks {
    count: usize,
    /// Samples of a block.
    length: f64,
}

impl Blocks {
    fn of(samples: &Samples<'_>, drive_hz: f64) -> Result<Self, SegmentationError> {
        let rate_hz = samples.rate_hz();
        if !(drive_hz > 0.0 && drive_hz < rate_hz / 4.0) {
            return Err(SegmentationError::Drive { drive_hz, rate_hz });
        }
        let cycles = samples.duration_s() * drive_hz;
        if cycles < MIN_RECORD_BLOCKS * CYCLES_PER_BLOCK {
            return Err(SegmentationError::Short {
                cycles,
                needed: MIN_RECORD_BLOCKS * CYCLES_PER_BLOCK,
            });
        }
        let length = CYCLES_PER_BLOCK * rate_hz / drive_hz;
        Ok(Self {
            count: (samples.values().len() as f64 / length) as usize,
            length,
        })
    }

    /// Features of each block.
    fn features(
        &self,
        samples: &Samples<'_>,
        drive_hz: f64,
        control: &Control,
    ) -> Result<Vec<Vec<f64>>, SegmentationError> {
        let start = |b: usize| (b as f64 * self.length).round() as usize;
        let features = (0..self.count)
            .take_while(|_| !control.is_stopped())
            .map(|b| block_features(samples, drive_hz, start(b), self.length.floor() as usize))
            .collect();
        if control.is_stopped() {
            return Err(SegmentationError::Stopped);
        }
        Ok(features)
    }

    /// Samples of the segment `k` of those that start at given blocks, and its samples without the
    /// blocks next to a change, which may contain both solutions.
    fn sample_ranges(
        &self,
        starts: &[f64],
        k: usize,
        samples: usize,
    ) -> ((usize, usize), (usize, usize)) {
        let boundary = |k: usize| {
            starts
                .get(k)
                .map_or(samples, |b| (b * self.length).round() as usize)
        };
        let (start, end) = (boundary(k), boundary(k + 1));
        let block = if end - start > (4.0 * self.length) as usize {
            self.length.ceil() as usize
        } else {
            0
        };
        let (is_first, is_last) = (k == 0, k + 1 == starts.len());
        let inner = (
            start + if is_first { 0 } else { block },
            end - if is_last { 0 } else { block },
        );
        ((start, end), inner)
    }
}

/// Drifts within periodic segments that no joint reports.
fn unreported_drifts(
    segments: &[RecordSegment],
    starts: &[f64],
    lines: &[Vec<c64>],
    joints: &[MergedChange],
) -> Vec<MergedChange> {
    let drifts_unreported = |(k, segment): &(usize, &RecordSegment)| {
        let is_reported = joints
            .iter()
            .any(|joint| (segment.start_s..segment.end_s).contains(&joint.at_s));
        let end = starts
            .get(k + 1)
            .map_or(lines.len(), |end| end.floor() as usize);
        segment.period.cycles.is_some()
            && !is_reported
            && drifts(&lines[starts[*k].ceil() as usize..end])
    };
    segments
        .iter()
        .enumerate()
        .filter(drifts_unreported)
        .map(|(_, segment)| MergedChange {
            at_s: 0.5 * (segment.start_s + segment.end_s),
            reason: MergeReason::Drifts,
        })
        .collect()
}

fn record_segment(
    samples: &Samples<'_>,
    drive_hz: f64,
    (start, end): (usize, usize),
    inner: (usize, usize),
    control: &Control,
) -> Result<RecordSegment, SegmentationError> {
    let inner_samples = Samples::new(&samples.values()[inner.0..inner.1], samples.rate_hz())?;
    let mean = inner_samples.mean();
    let rms = (inner_samples
        .values()
        .iter()
        .map(|x| (x - mean).powi(2))
        .sum::<f64>()
        / inner_samples.values().len() as f64)
        .sqrt();
    let at = |k: usize| k as f64 / samples.rate_hz();
    let period =
        period_watched(&inner_samples, drive_hz, control).ok_or(SegmentationError::Stopped)?;
    Ok(RecordSegment {
        start_s: at(start),
        end_s: at(end),
        start,
        end,
        inner,
        rms,
        period,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_signal::RandomStream;
    use std::f64::consts::TAU;

    /// 85 s at 1536 Hz under 13 Hz: a small response, from 31.7 s a large one of two cycles, from
    /// 60.2 s the small one again.
    fn switching(noise: f64) -> Vec<f64> {
        let mut stream = RandomStream::new(11, 0);
        (0..130_560)
            .map(|k| {
                let t = f64::from(k) / 1536.0;
                let large = (31.7..60.2).contains(&t);
                let (a, b) = if large { (3.0, 1.2) } else { (1.0, 0.0) };
                a * (TAU * 13.0 * t).sin()
                    + b * (TAU * 6.5 * t).cos()
                    + noise * stream.normal_pair()[0]
            })
            .collect()
    }

    /// Measured: both changes within 0.085 s, a block is 0.46 s; also with noise of a third of the
    /// small response.
    #[test]
    fn solution_changes_and_periods_are_found_at_any_noise() {
        for noise in [0.0, 0.3] {
            let values = switching(noise);
            let result = segments(&Samples::new(&values, 1536.0).unwrap(), 13.0).unwrap();
            assert_eq!(result.segments.len(), 3, "{noise}: {:?}", result.segments);
            for (k, change) in [(1, 31.7), (2, 60.2)] {
                assert!(
                    (result.segments[k].start_s - change).abs() < result.uncertainty_s,
                    "{noise} {}",
                    result.segments[k].start_s
                );
            }
            let cycles: Vec<_> = result
                .segments
                .iter()
                .map(|segment| segment.period.cycles)
                .collect();
            assert_eq!(cycles, [Some(1), Some(2), Some(1)], "{noise}");
        }
    }

    #[test]
    fn noise_is_one_segment_and_errors_are_reported() {
        let mut stream = RandomStream::new(2, 0);
        let values: Vec<f64> = (0..60_000)
            .map(|k| (TAU * 13.0 * f64::from(k) / 1536.0).sin() + 0.5 * stream.normal_pair()[0])
            .collect();
        let samples = Samples::new(&values, 1536.0).unwrap();
        assert_eq!(segments(&samples, 13.0).unwrap().segments.len(), 1);
        assert!(matches!(
            segments(&samples, 500.0),
            Err(SegmentationError::Drive { .. })
        ));
        assert!(matches!(
            segments(&samples, 0.1),
            Err(SegmentationError::Short { .. })
        ));
        assert_eq!(
            segments(&Samples::new(&[1.0; 9000], 100.0).unwrap(), 5.0),
            Err(SegmentationError::Constant)
        );
        let control = Control::default();
        control.stop();
        assert_eq!(
            segments_watched(&samples, 13.0, &control),
            Err(SegmentationError::Stopped)
        );
    }
}
