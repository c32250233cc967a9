//! After how many drive cycles a record repeats.

use jounce::march::Watch;
use jounce::signal::Samples;
use serde::Serialize;

/// How a stretch repeats.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Period {
    /// Drive cycles of the period; none where it does not repeat within twelve cycles.
    pub cycles: Option<usize>,
    /// Rms of `x(t + n T) - x(t)` over `sqrt 2` times the rms of `x`, for that `n`, or for the best one: 0 for a perfect repetition, about 1
    /// for none. Noise of a share `s` of the rms gives `s`.
    pub mismatch: f64,
}

/// Longest period sought, drive cycles.
pub const LONGEST_PERIOD: usize = 12;
/// A shorter period is the period where its mismatch is at most this many times the smallest one, or below the second number.
const AS_WELL: f64 = 1.5;
const EXACT: f64 = 0.01;
/// Longest period that is looked for to tell that none of those sought fits, and about how many samples tell it.
const BEYOND: usize = 48;
const SPARSE: usize = 16_384;
/// Beyond this there is no repetition.
const NONE: f64 = 0.5;

/// The period of samples under a drive of a known frequency; samples between those of the record by cubic interpolation.
pub fn period(samples: &Samples<'_>, drive_hz: f64) -> Period {
    let unstopped = period_watched(samples, drive_hz, &Watch::default());
    unstopped.unwrap_or(Period { cycles: None, mismatch: f64::INFINITY })
}

/// The same under a watch, which is looked at before each number of cycles; none where it stops the search.
pub(super) fn period_watched(samples: &Samples<'_>, drive_hz: f64, watch: &Watch) -> Option<Period> {
    let values = samples.values();
    let mean = samples.mean();
    let rms = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt();
    // Every so many samples will do to tell whether a longer period fits better.
    let sparse = (values.len() / SPARSE).max(1);
    let mismatch_of = |cycles: usize, step: usize| {
        let shift = cycles as f64 * samples.rate_hz() / drive_hz;
        let (whole, share) = (shift.floor() as usize, shift.fract());
        let end = values.len().saturating_sub(whole + 2);
        if end < 2 || end * 3 < values.len() {
            return f64::INFINITY;
        }
        let square = |k: usize| (cubic(&values[k + whole - 1..k + whole + 3], share) - values[k]).powi(2);
        let sum: f64 = (1..end).step_by(step).map(square).sum();
        (sum / (end - 1).div_ceil(step) as f64 / 2.0).sqrt() / rms
    };
    let found: Vec<f64> = (1..=LONGEST_PERIOD).take_while(|_| !watch.is_stopped()).map(|cycles| mismatch_of(cycles, 1)).collect();
    if watch.is_stopped() {
        return None;
    }
    let least = found.iter().copied().fold(f64::INFINITY, f64::min);
    let best = found.iter().position(|m| *m <= (AS_WELL * least).max(EXACT));
    // A period beyond the longest one that is sought makes all shorter ones miss more than it does.
    let beyond = || (LONGEST_PERIOD + 1..=BEYOND).map(|cycles| mismatch_of(cycles, sparse)).fold(f64::INFINITY, f64::min);
    let longer = || least > EXACT && least > AS_WELL * beyond();
    Some(match best.filter(|_| least < NONE && !longer()) {
        Some(k) => Period { cycles: Some(k + 1), mismatch: found[k] },
        None => Period { cycles: None, mismatch: least },
    })
}

/// Lagrange's cubic through four samples, between the middle two.
pub(super) fn cubic(y: &[f64], t: f64) -> f64 {
    let [a, b, c, d] = [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ];
    a * y[0] + b * y[1] + c * y[2] + d * y[3]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce::drive::Stream;
    use std::f64::consts::TAU;

    #[test]
    fn subharmonics_are_found_in_noise_and_noise_has_no_period() {
        let mut stream = Stream::new(4, 0);
        let noise: Vec<f64> = (0..20_000).map(|_| stream.normal_pair()[0]).collect();
        for (cycles, level) in [(1, 0.0), (2, 0.1), (3, 0.1), (5, 0.02)] {
            let value = |k: usize| {
                let t = k as f64 / 1536.0 * 13.0;
                (TAU * t).sin() + 0.4 * (TAU * t / cycles as f64).cos() + level * noise[k]
            };
            let values: Vec<f64> = (0..20_000).map(value).collect();
            assert_eq!(period(&Samples::new(&values, 1536.0).unwrap(), 13.0).cycles, Some(cycles), "{cycles}");
        }
        assert_eq!(period(&Samples::new(&noise, 1536.0).unwrap(), 13.0).cycles, None);
    }

    /// Small subharmonics of orders up to the longest one sought are found; those beyond are not taken for a shorter period.
    #[test]
    fn a_period_beyond_the_longest_one_sought_is_none() {
        let mut stream = Stream::new(5, 0);
        let noise: Vec<f64> = (0..60_000).map(|_| 0.01 * stream.normal_pair()[0]).collect();
        for (cycles, expected) in [(9, Some(9)), (12, Some(12)), (13, None), (16, None), (24, None), (48, None)] {
            let value = |k: usize| {
                let t = k as f64 / 1536.0 * 13.0;
                (TAU * t).sin() + 0.2 * (TAU * t / f64::from(cycles)).sin() + noise[k]
            };
            let values: Vec<f64> = (0..60_000).map(value).collect();
            let found = period(&Samples::new(&values, 1536.0).unwrap(), 13.0);
            assert_eq!(found.cycles, expected, "{cycles}: {found:?}");
        }
    }
}
