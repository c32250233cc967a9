//! Merges neighbouring segments of one solution that differ only by the noise, a slow drift, or one
//! irregular block.
//!
//! For each segment the amplitude at each order is corrected for noise over its blocks `b`:
//! `A^2 = mean |x_b|^2 - mean |x_b+1 - x_b|^2 / 2`. Equal amplitudes and equal periods mean one
//! solution. Amplitudes of equal shape that differ overall but hardly across the change indicate
//! drift.

use jounce_linalg::c64;
use jounce_signal::Samples;
use serde::Serialize;

use super::features::block_lines;
use super::period;
use super::segment_features::{EQUAL_AMPLITUDE_SHARE, NOISE_DEVIATIONS, SegmentFeatures};

/// Reason why a change is not a change of solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MergeReason {
    /// The aperiodic part changed in size.
    NoiseChanged,
    /// The amplitude changes slowly, with constant shape.
    Drifts,
    /// A single block differs.
    Glitch,
}

/// Change that is not a change of solution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MergedChange {
    /// Time, s from the first sample.
    pub at_s: f64,
    /// Reason.
    pub reason: MergeReason,
}

/// Ratio of the noise of two segments above which the noise changed.
const NOISE_CHANGE_RATIO: f64 = 1.2;
/// Maximum share of a drift's change that occurs across the cut.
const MAX_DRIFT_STEP_SHARE: f64 = 0.3;
/// Blocks on both sides used to detect a sudden change, and blocks at the change that may contain
/// both.
const NEIGHBOUR_BLOCKS: usize = 3;
const TRANSITION_BLOCKS: usize = 1;
/// Maximum length in blocks of a glitch between two segments of one solution.
const MAX_GLITCH_BLOCKS: f64 = 2.0;

/// Returns the starts of segments, in blocks, without merged changes, and the merged changes.
pub(super) fn merge_segments(
    samples: &Samples<'_>,
    drive_hz: f64,
    mut starts: Vec<f64>,
    (lines, length): (&[Vec<c64>], f64),
) -> (Vec<f64>, Vec<MergedChange>) {
    let count = lines.len();
    let mut joints = Vec::new();
    if starts.len() < 2 {
        return (starts, joints);
    }
    let same_period = |from: (f64, f64), to: (f64, f64)| {
        let cycles = |(from, to): (f64, f64)| {
            let values = &samples.values()[(from.ceil() * length) as usize
                ..((to.floor() * length) as usize).min(samples.values().len())];
            Samples::new(values, samples.rate_hz())
                .ok()
                .and_then(|segment| period(&segment, drive_hz).cycles)
        };
        let (one, other) = (cycles(from), cycles(to));
        one.is_some() && one == other
    };
    let mut k = 1;
    while k < starts.len() {
        let end = |k: usize| starts.get(k).copied().unwrap_or(count as f64);
        let (previous, next) = ((starts[k - 1], starts[k]), (starts[k], end(k + 1)));
        let is_short = k + 1 < starts.len() && starts[k + 1] - starts[k] <= MAX_GLITCH_BLOCKS;
        let second_next = (end(k + 1), end(k + 2));
        if is_short
            && merge_reason(lines, previous, second_next).is_some()
            && same_period(previous, second_next)
        {
            joints.push(MergedChange {
                at_s: starts[k] * length / samples.rate_hz(),
                reason: MergeReason::Glitch,
            });
            starts.drain(k..k + 2);
            continue;
        }
        match merge_reason(lines, previous, next).filter(|_| same_period(previous, next)) {
            Some(reason) => {
                joints.push(MergedChange {
                    at_s: starts[k] * length / samples.rate_hz(),
                    reason,
                });
                starts.remove(k);
            }
            None => k += 1,
        }
    }
    (starts, joints)
}

/// Computes the lines of each block of a record.
pub(super) fn lines(
    samples: &Samples<'_>,
    drive_hz: f64,
    (count, length): (usize, f64),
) -> Vec<Vec<c64>> {
    let first = |b: usize| (b as f64 * length).round() as usize;
    (0..count)
        .map(|b| block_lines(samples, drive_hz, first(b), length.floor() as usize))
        .collect()
}

/// True where the amplitude of a segment changes from its first third to its last.
pub(super) fn drifts(lines: &[Vec<c64>]) -> bool {
    let third = lines.len() / 3;
    if third < 2 {
        return false;
    }
    let (first, last) = (
        SegmentFeatures::of(&lines[..third]),
        SegmentFeatures::of(&lines[lines.len() - third..]),
    );
    !first.equals(&last) && first.is_shaped_as(&last)
}

/// Reason why two neighbouring segments are one; `None` where they are not.
fn merge_reason(lines: &[Vec<c64>], previous: (f64, f64), next: (f64, f64)) -> Option<MergeReason> {
    let blocks = |(from, to): (f64, f64)| {
        &lines[from.ceil() as usize..(to.floor() as usize).min(lines.len())]
    };
    let (one, two) = (blocks(previous), blocks(next));
    if one.len() < 2 || two.len() < 2 {
        return None;
    }
    let (a, b) = (SegmentFeatures::of(one), SegmentFeatures::of(two));
    if a.equals(&b) {
        let noise_changed = a.noise.max(b.noise) > NOISE_CHANGE_RATIO * a.noise.min(b.noise);
        let is_outlier = |block: &Vec<c64>| {
            let magnitudes: Vec<f64> = block.iter().map(|x| x.norm()).collect();
            let deviation = magnitudes
                .iter()
                .zip(&a.amplitude)
                .map(|(x, a)| (x - a).abs())
                .fold(0.0, f64::max);
            deviation
                > EQUAL_AMPLITUDE_SHARE * a.largest_amplitude()
                    + NOISE_DEVIATIONS * a.noise.max(b.noise)
        };
        let boundary = next.0.floor() as usize;
        let is_glitch = lines[boundary.saturating_sub(TRANSITION_BLOCKS)
            ..(boundary + TRANSITION_BLOCKS + 1).min(lines.len())]
            .iter()
            .any(is_outlier);
        return Some(match (noise_changed, is_glitch) {
            (_, true) => MergeReason::Glitch,
            (true, false) => MergeReason::NoiseChanged,
            (false, false) => MergeReason::Drifts,
        });
    }
    let last = one.len().saturating_sub(TRANSITION_BLOCKS);
    let neighbours = (
        &one[last.saturating_sub(NEIGHBOUR_BLOCKS)..last],
        &two[TRANSITION_BLOCKS..(TRANSITION_BLOCKS + NEIGHBOUR_BLOCKS).min(two.len())],
    );
    if !a.is_shaped_as(&b)
        || neighbours.0.len() < NEIGHBOUR_BLOCKS
        || neighbours.1.len() < NEIGHBOUR_BLOCKS
    {
        return None;
    }
    (SegmentFeatures::of(neighbours.0).amplitude_difference(&SegmentFeatures::of(neighbours.1))
        < MAX_DRIFT_STEP_SHARE * a.amplitude_difference(&b))
    .then_some(MergeReason::Drifts)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::{Segmentation, segments};
    use super::*;
    use jounce_signal::RandomStream;
    use std::f64::consts::TAU;

    /// 85 s at 1536 Hz under 13 Hz, made by `value(time, noise)`.
    fn segment_record(value: impl Fn(f64, f64) -> f64) -> Segmentation {
        let mut stream = RandomStream::new(21, 0);
        let values: Vec<f64> = (0..130_560)
            .map(|k| value(f64::from(k) / 1536.0, stream.normal_pair()[0]))
            .collect();
        segments(&Samples::new(&values, 1536.0).unwrap(), 13.0).unwrap()
    }

    fn base(t: f64) -> f64 {
        (TAU * 13.0 * t).sin() + 0.3 * (TAU * 26.0 * t).cos()
    }

    #[test]
    fn noise_changes_drifts_and_glitches_do_not_split_segments() {
        let noise = segment_record(|t, n| base(t) + n * if t < 40.0 { 0.1 } else { 0.4 });
        assert_eq!(noise.segments.len(), 1, "{:?}", noise.joints);
        assert!(
            noise
                .joints
                .iter()
                .any(|j| j.reason == MergeReason::NoiseChanged && (j.at_s - 40.0).abs() < 0.5),
            "{:?}",
            noise.joints
        );
        let drift = segment_record(|t, n| base(t) * (1.0 + 0.3 * t / 85.0) + 0.02 * n);
        assert_eq!(drift.segments.len(), 1, "{:?}", drift.segments);
        assert!(
            !drift.joints.is_empty()
                && drift
                    .joints
                    .iter()
                    .all(|joint| joint.reason == MergeReason::Drifts),
            "{:?}",
            drift.joints
        );
        let glitch = segment_record(|t, n| {
            base(t) + 0.02 * n + if (40.0..40.2).contains(&t) { 3.0 } else { 0.0 }
        });
        assert_eq!(glitch.segments.len(), 1, "{:?}", glitch.segments);
        assert!(
            glitch.joints.iter().any(|joint| joint.reason == MergeReason::Glitch && (joint.at_s - 40.0).abs() < 0.5),
            "{:?}",
            glitch.joints
        );
    }

    /// A slow ramp of any course, up from a tenth of its end, is one segment with drift.
    /// Segmentation by the mean gave 18.
    #[test]
    fn slow_ramp_is_one_segment() {
        let amplitude_profiles = [
            |s: f64| 0.2 + 2.0 * s,
            |s: f64| 0.2 + 2.0 * s * s,
            |s: f64| 0.2 + 2.0 * (2.0 * s).min(1.0),
        ];
        for (k, amplitude_at) in amplitude_profiles.into_iter().enumerate() {
            let result = segment_record(|t, n| base(t) * amplitude_at(t / 85.0) + 0.02 * n);
            assert_eq!(
                result.segments.len(),
                1,
                "{k}: {:?} {:?}",
                result.segments,
                result.joints
            );
            assert!(
                !result.joints.is_empty()
                    && result
                        .joints
                        .iter()
                        .all(|joint| joint.reason == MergeReason::Drifts),
                "{k}: {:?}",
                result.joints
            );
        }
    }

    /// 25 s of an irregular motion, whose amplitude changes at random from cycle to cycle, before
    /// it settles: one segment, and then the other. Segmentation by the mean gave about fifty at
    /// the start. By chance a part of it may be a separate segment, as in 1 of 100 records.
    #[test]
    fn irregular_start_is_one_segment() {
        let mut single_segment_starts = 0;
        for seed in 1..11 {
            let mut stream = RandomStream::new(seed, 5);
            let mut amplitudes = [1.0, 0.5, 0.3];
            let mut values = Vec::new();
            for k in 0..130_560 {
                let t = f64::from(k) / 1536.0;
                let [noise, other] = stream.normal_pair();
                if k % 118 == 0 {
                    let [one, two] = stream.normal_pair();
                    amplitudes = [
                        0.4 + 0.6 * amplitudes[0] + 0.5 * one,
                        0.6 * amplitudes[1] + 0.5 * two,
                        0.6 * amplitudes[2] + 0.5 * other,
                    ];
                }
                let irregular = 1.5 * amplitudes[0] * (TAU * 13.0 * t).sin()
                    + amplitudes[1] * (TAU * 6.5 * t).cos()
                    + amplitudes[2] * (TAU * 13.0 / 3.0 * t).sin();
                values.push(if t < 25.0 { irregular } else { 1.5 * base(t) } + 0.02 * noise);
            }
            let result = segments(&Samples::new(&values, 1536.0).unwrap(), 13.0).unwrap();
            let [start, .., last] = &result.segments[..] else {
                panic!("{seed}: {:?}", result.segments)
            };
            assert!(
                result.segments.len() <= 3
                    && (last.start_s - 25.0).abs() < 2.0 * result.uncertainty_s,
                "{seed}: {:?}",
                result.segments
            );
            assert_eq!(
                (start.period.cycles, last.period.cycles),
                (None, Some(1)),
                "{seed}"
            );
            single_segment_starts += u32::from(result.segments.len() == 2);
        }
        assert!(
            single_segment_starts >= 9,
            "{single_segment_starts} of 10 starts are one segment"
        );
    }

    /// A jump only in size, as at the fold of a nearly linear response, and one only in shape, are
    /// other solutions.
    #[test]
    fn jumps_split_segments() {
        for changed_signal in [
            |t: f64| 1.4 * base(t),
            |t: f64| (TAU * 13.0 * t).sin() + 0.6 * (TAU * 26.0 * t).cos(),
        ] {
            let result =
                segment_record(|t, n| if t < 40.0 { base(t) } else { changed_signal(t) } + 0.1 * n);
            assert_eq!(
                (result.segments.len(), result.joints.len()),
                (2, 0),
                "{:?}",
                result.joints
            );
        }
    }
}
