//! Finds the period of a record in drive cycles.
//!
//! The record is sampled at equal phases of the drive, a row of values for each cycle. Folded at
//! `n` cycles, every `n`-th row is one class, and
//!
//! ```text
//! V_n = mean over rows of |x - mean of its class|^2 M / (M - 1),   M rows of the class
//! ```
//!
//! is the noise variance for the period and its multiples. It is larger for every other `n`, by all
//! subharmonics that `n` cycles do not contain. The period is the smallest `n` whose `V_n` does not
//! exceed the smallest one of all significantly, by batches of rows, or by more than a hundredth of
//! the rms. Classes are formed within windows, so a small error of the drive frequency does not
//! blur them.
//!
//! Slow noise is similar at some distances by chance. Folding at such a number leaves less, but so
//! does folding at neighbouring numbers; a true period leaves less only at its multiples. If the
//! first criterion finds no period, the result is the smallest `n` after whose removal the best
//! number leaves no less than its neighbours.

use jounce_control::Control;
use jounce_signal::Samples;
use serde::Serialize;

use super::cycles::{Cycles, FoldResidual};

/// Repetition of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RepetitionPeriod {
    /// Drive cycles of the period; `None` where it does not repeat within twelve cycles.
    pub cycles: Option<usize>,
    /// RMS of `x(t + n T) - x(t)` over `sqrt 2` times the RMS of `x`, for that `n`, or for the best
    /// one: 0 for a perfect repetition, about 1 for an aperiodic record. Noise of a share `s` of
    /// the rms gives `s`.
    pub mismatch: f64,
}

/// Longest period sought, drive cycles.
pub const MAX_PERIOD_CYCLES: usize = 12;
/// Longest period tested to exclude all those sought.
const MAX_TESTED_PERIOD_CYCLES: usize = 48;
/// Maximum ratio to the smallest residual that chance alone explains for slow noise.
const CHANCE_FACTOR: f64 = 3.0;
/// Residual above which the record is aperiodic.
const MAX_RESIDUAL_SHARE: f64 = 0.5;

/// Finds the period of samples under a drive of known frequency; values between samples are
/// interpolated cubically.
pub fn period(samples: &Samples<'_>, drive_hz: f64) -> RepetitionPeriod {
    let result = period_watched(samples, drive_hz, &Control::default());
    result.unwrap_or(RepetitionPeriod {
        cycles: None,
        mismatch: f64::INFINITY,
    })
}

/// Finds the period, with a cancellation check before each number of cycles; `None` if cancelled.
pub(super) fn period_watched(
    samples: &Samples<'_>,
    drive_hz: f64,
    control: &Control,
) -> Option<RepetitionPeriod> {
    let cycles = Cycles::of(samples, drive_hz);
    let longest_period =
        MAX_TESTED_PERIOD_CYCLES.min(cycles.windows().last().map_or(0, |window| window.len() / 2));
    let fold_residuals: Vec<FoldResidual> = (1..=longest_period)
        .take_while(|_| !control.is_stopped())
        .map(|n| FoldResidual::of(&cycles.fold_residuals(n)))
        .collect();
    if control.is_stopped() {
        return None;
    }
    let Some((best_period, best)) = (1..)
        .zip(&fold_residuals)
        .min_by(|(_, a), (_, b)| a.mean.total_cmp(&b.mean))
    else {
        return Some(RepetitionPeriod {
            cycles: None,
            mismatch: f64::INFINITY,
        });
    };
    let candidates = || (1..).zip(&fold_residuals).take(MAX_PERIOD_CYCLES);
    let is_chance_match = |(n, one): &(usize, &FoldResidual)| {
        one.mean <= CHANCE_FACTOR * best.mean
            && cycles
                .without_period(*n)
                .is_smooth_at(best_period, longest_period)
    };
    let found = candidates()
        .find(|(_, one)| one.fits_as_well_as(best, cycles.mean_square))
        .or_else(|| candidates().find(is_chance_match))
        .map(|(n, _)| n);
    Some(
        match found
            .map(|n| (n, cycles.mismatch(n)))
            .filter(|(_, mismatch)| *mismatch < MAX_RESIDUAL_SHARE)
        {
            Some((n, mismatch)) => RepetitionPeriod {
                cycles: Some(n),
                mismatch,
            },
            None => {
                let all = (1..=longest_period.min(MAX_PERIOD_CYCLES)).map(|n| cycles.mismatch(n));
                RepetitionPeriod {
                    cycles: None,
                    mismatch: all.fold(f64::INFINITY, f64::min),
                }
            }
        },
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_signal::RandomStream;
    use std::f64::consts::TAU;

    #[test]
    fn subharmonics_are_found_in_noise_and_noise_has_no_period() {
        let mut stream = RandomStream::new(4, 0);
        let noise: Vec<f64> = (0..20_000).map(|_| stream.normal_pair()[0]).collect();
        for (cycles, level) in [(1, 0.0), (2, 0.1), (3, 0.1), (5, 0.02)] {
            let value = |k: usize| {
                let t = k as f64 / 1536.0 * 13.0;
                (TAU * t).sin() + 0.4 * (TAU * t / cycles as f64).cos() + level * noise[k]
            };
            let values: Vec<f64> = (0..20_000).map(value).collect();
            assert_eq!(
                period(&Samples::new(&values, 1536.0).unwrap(), 13.0).cycles,
                Some(cycles),
                "{cycles}"
            );
        }
        assert_eq!(
            period(&Samples::new(&noise, 1536.0).unwrap(), 13.0).cycles,
            None
        );
    }

    /// Small subharmonics of orders up to the longest one sought are found; those beyond do not
    /// give a shorter period.
    #[test]
    fn periods_beyond_the_limit_are_not_reported() {
        let mut stream = RandomStream::new(5, 0);
        let noise: Vec<f64> = (0..60_000)
            .map(|_| 0.01 * stream.normal_pair()[0])
            .collect();
        for (cycles, expected) in [
            (9, Some(9)),
            (12, Some(12)),
            (13, None),
            (16, None),
            (24, None),
            (48, None),
        ] {
            let value = |k: usize| {
                let t = k as f64 / 1536.0 * 13.0;
                (TAU * t).sin() + 0.2 * (TAU * t / f64::from(cycles)).sin() + noise[k]
            };
            let values: Vec<f64> = (0..60_000).map(value).collect();
            let found = period(&Samples::new(&values, 1536.0).unwrap(), 13.0);
            assert_eq!(found.cycles, expected, "{cycles}: {found:?}");
        }
    }

    /// Every period up to the longest one sought, and four beyond it, in clean records and in noise
    /// of 2 and 5 % of the rms: the subharmonic, of any order with that denominator, is a fifth of
    /// the response at the drive frequency.
    #[test]
    fn every_order_is_found_in_clean_and_in_noisy_records() {
        let mut failures = Vec::new();
        for (cycles, seed) in [(100, 0), (300, 1), (300, 2)] {
            let mut stream = RandomStream::new(seed, 7);
            for order in 1..=16_usize {
                let numerators: Vec<usize> = (1..=order)
                    .filter(|numerator| {
                        (2..=*numerator).all(|d| numerator % d > 0 || order % d > 0)
                    })
                    .collect();
                let numerator = numerators[(7 * order + seed as usize) % numerators.len()];
                let phase = stream.normal_pair();
                let subharmonic_amplitude = if order > 1 { 0.2 } else { 0.0 };
                let signal = |k: usize| {
                    let angle = TAU * k as f64 / 1536.0 * 13.0;
                    angle.sin()
                        + 0.3 * (2.0 * angle + phase[0]).sin()
                        + subharmonic_amplitude
                            * (angle * numerator as f64 / order as f64 + phase[1]).sin()
                };
                for noise in [0.0, 0.02, 0.05] {
                    let values: Vec<f64> = (0..cycles * 1536 / 13)
                        .map(|k| signal(k) + 0.74 * noise * stream.normal_pair()[0])
                        .collect();
                    let found = period(&Samples::new(&values, 1536.0).unwrap(), 13.0);
                    if found.cycles != Some(order).filter(|order| *order <= MAX_PERIOD_CYCLES) {
                        failures.push((cycles, order, numerator, noise, found));
                    }
                }
            }
        }
        assert!(failures.is_empty(), "{failures:?}");
    }

    /// Noise with a correlation length of eight cycles out of a hundred is similar at some distance
    /// by chance: every order is found in noise of 2 and 5 % of the rms, and longer periods give
    /// `None`.
    #[test]
    fn slow_noise_gives_no_long_period() {
        let mut failures = Vec::new();
        for seed in 0..12 {
            for (order, noise) in (1..=20).flat_map(|order| [(order, 0.02), (order, 0.05)]) {
                let mut stream = RandomStream::new(seed * 1000 + order, 23);
                let numerators: Vec<u64> = (1..=order)
                    .filter(|numerator| {
                        (2..=*numerator).all(|d| numerator % d > 0 || order % d > 0)
                    })
                    .collect();
                let frequency_ratio = numerators[(7 * order + seed) as usize % numerators.len()]
                    as f64
                    / order as f64;
                let phase = stream.normal_pair();
                let subharmonic_amplitude = if order > 1 { 0.2 } else { 0.0 };
                let mut slow = stream.normal_pair()[0];
                let mut value = |k: usize| {
                    slow =
                        0.999 * slow + (1.0_f64 - 0.999 * 0.999).sqrt() * stream.normal_pair()[0];
                    let angle = TAU * k as f64 / 1536.0 * 13.0;
                    angle.sin()
                        + 0.3 * (2.0 * angle + phase[0]).sin()
                        + subharmonic_amplitude * (angle * frequency_ratio + phase[1]).sin()
                        + 0.74 * noise * slow
                };
                let values: Vec<f64> = (0..100 * 1536 / 13).map(&mut value).collect();
                let found = period(&Samples::new(&values, 1536.0).unwrap(), 13.0);
                if found.cycles.map(|cycles| cycles as u64)
                    != Some(order).filter(|order| *order <= 12)
                {
                    failures.push((seed, order, noise, found));
                }
            }
        }
        assert!(failures.is_empty(), "{failures:?}");
    }

    /// A drive that is off by a thousandth turns by half a cycle in 500; the noise has a
    /// correlation length of nine cycles.
    #[test]
    fn drive_frequency_error_and_slow_noise_do_not_hide_the_period() {
        let mut stream = RandomStream::new(6, 0);
        for order in [1, 2, 3, 12] {
            let mut slow = 0.0;
            let mut value = |k: usize| {
                slow = 0.999 * slow + 0.0016 * stream.normal_pair()[0];
                let angle = TAU * 1.001 * k as f64 / 1536.0 * 13.0;
                let subharmonic_amplitude = if order > 1 { 0.2 } else { 0.0 };
                angle.sin() + subharmonic_amplitude * (angle / order as f64 + 0.3).sin() + slow
            };
            let values: Vec<f64> = (0..60_000).map(&mut value).collect();
            let found = period(&Samples::new(&values, 1536.0).unwrap(), 13.0);
            assert_eq!(found.cycles, Some(order), "{found:?}");
        }
    }
}
