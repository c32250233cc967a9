//! Checks that a structure is at rest before a hit.

use crate::Samples;

use super::HitWarning;

/// Share of the pre-trigger interval that is skipped: anti-aliasing filters let a pulse begin
/// early.
const SKIPPED_SHARE: f64 = 1.0 / 3.0;
/// Minimum number of samples for the check, and the share of the block's RMS above which the
/// structure is not at rest. The share is small because a slow mode has small accelerations.
const MIN_QUIET_SAMPLES: usize = 16;
const MIN_RINGING_SHARE: f64 = 1e-3;
/// Minimum ratio of a motion to the noise.
const MIN_NOISE_RATIO: f64 = 2.0;

/// Response with the largest motion before its hit, if any. Noise, estimated from the third
/// differences, is not motion.
pub(super) fn ringing(
    responses: &[Samples<'_>],
    (start, hit): (usize, usize),
    length: usize,
) -> Option<HitWarning> {
    let end =
        hit.saturating_sub((SKIPPED_SHARE * hit.saturating_sub(start) as f64).ceil() as usize);
    if end < start + MIN_QUIET_SAMPLES {
        return None;
    }
    // About their own mean: an offset is not motion.
    let rms = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
    };
    let motion_share = |response: &Samples<'_>| {
        let pre_trigger = &response.values()[start..end];
        let third_differences = pre_trigger
            .windows(4)
            .map(|x| (x[3] - 3.0 * x[2] + 3.0 * x[1] - x[0]).powi(2))
            .sum::<f64>();
        let noise = (third_differences / 20.0 / (pre_trigger.len() - 3) as f64).sqrt();
        let (motion, block) = (
            rms(pre_trigger),
            rms(&response.values()[start..start + length]),
        );
        if motion > MIN_NOISE_RATIO * noise {
            motion / block
        } else {
            0.0
        }
    };
    let largest_share = responses.iter().map(motion_share).fold(0.0, f64::max);
    (largest_share > MIN_RINGING_SHARE).then_some(HitWarning::Ringing {
        share: largest_share,
    })
}
