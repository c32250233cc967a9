//! Matches a segment of a record to the solutions of a model.
//!
//! The segment is cut into pieces of at least 24 drive cycles. In each, the lines `X_j` at the
//! orders `j / m` up to 8 are compared with the lines `C_j` of a solution's voltage. A record
//! contains neither its phase relative to the drive nor its polarity, so both are free:
//!
//! ```text
//! d^2 = min over s = +-1, u   sum_j |X_j - s C_j exp(2 pi i j u / m)|^2  /  sum_j |X_j|^2
//! ```
//!
//! with `u` in drive cycles and `m` the common period of the segment and the solution. The distance
//! of the waveforms is the root of the mean of `d^2` over the pieces: 0 for equal waveforms, 1 for
//! orthogonal ones. Slow drift of the shaker has no effect, and noise adds only `2 s^2 J / N` to
//! each sum, for `J` lines of `N` samples. The distance of the spectra is `d` with magnitudes
//! `|X_j|` and `|C_j|`, without phases.

use jounce_linalg::c64;
use jounce_signal::Samples;
use serde::Serialize;

use super::RecordSegment;
use super::features::line;
use super::shift::least_distance;
use crate::solution::{MAX_ORDER, Solution, Waveform};

/// Comparison of a solution with a segment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Candidate {
    /// Id of the solution.
    pub id: String,
    /// Drive cycles of its period.
    pub period_cycles: Option<u32>,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Distance of the waveforms; `None` for an aperiodic solution.
    pub waveform_distance: Option<f64>,
    /// Distance of the spectra.
    pub spectrum_distance: Option<f64>,
    /// Mean square of the segment about its mean, relative to the waveform.
    pub power_ratio: Option<f64>,
    /// True where the record has the opposite polarity.
    pub inverted: bool,
}

/// Result of matching a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SegmentMatch {
    /// The first candidate.
    One,
    /// The first two fit equally well.
    Several,
    /// No candidate is near enough.
    None,
}

/// Solutions compared with a segment, in order of distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SegmentMatches {
    /// Result of the match.
    pub fits: SegmentMatch,
    /// All solutions of the model in order of distance, aperiodic ones last.
    pub candidates: Vec<Candidate>,
}

impl SegmentMatches {
    /// Returns the id of the only solution that fits.
    pub fn id(&self) -> Option<&str> {
        (self.fits == SegmentMatch::One).then(|| self.candidates[0].id.as_str())
    }
}

/// Minimum number of drive cycles of a piece.
const MIN_PIECE_CYCLES: f64 = 24.0;
/// Maximum ratio of its distance to the smallest one at which a second solution fits equally well.
const EQUAL_FIT_RATIO: f64 = 1.5;
/// Maximum ratio of squared distances at which the opposite polarity is preferred.
const POLARITY_RATIO: f64 = 0.5;
/// Longest common period.
const MAX_COMMON_PERIOD: u32 = 24;

/// Compares a segment with the solutions of a model: the nearest fits if its distance is at most
/// `limit` (0.2 is a model within 20 %). An aperiodic segment has no waveform, so no solution fits
/// it, even a chaotic one of equal power.
pub fn match_segments(
    samples: &Samples<'_>,
    drive_hz: f64,
    segment: &RecordSegment,
    solutions: &[Solution],
    limit: f64,
) -> SegmentMatches {
    let values = &samples.values()[segment.inner.0..segment.inner.1];
    let candidate_of = |solution: &Solution| {
        let waveform = solution
            .waveform
            .as_ref()
            .filter(|_| segment.period.cycles.is_some());
        let found = waveform
            .and_then(|waveform| compare(values, samples.rate_hz(), drive_hz, segment, waveform));
        let mean_square =
            |waveform: &Waveform| waveform.lines_v.iter().map(|c| c.norm_sqr()).sum::<f64>() / 2.0;
        Candidate {
            id: solution.id.clone(),
            period_cycles: solution.period_cycles,
            mean_power_w: solution.mean_power_w,
            waveform_distance: found.map(|found| found.waveform),
            spectrum_distance: found.map(|found| found.spectrum),
            power_ratio: waveform.map(|waveform| segment.rms.powi(2) / mean_square(waveform)),
            inverted: found.is_some_and(|found| found.inverted),
        }
    };
    let mut candidates: Vec<Candidate> = solutions.iter().map(candidate_of).collect();
    let distance = |candidate: &Candidate| candidate.waveform_distance.unwrap_or(f64::INFINITY);
    candidates.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    let at = |k: usize| candidates.get(k).map_or(f64::INFINITY, distance);
    let fits = match (at(0), at(1)) {
        (first, _) if first > limit => SegmentMatch::None,
        (first, second) if second <= (EQUAL_FIT_RATIO * first).min(limit) => SegmentMatch::Several,
        _ => SegmentMatch::One,
    };
    SegmentMatches { fits, candidates }
}

/// Distances of one waveform.
#[derive(Clone, Copy)]
struct WaveformDistance {
    waveform: f64,
    spectrum: f64,
    inverted: bool,
}

/// Compares a waveform; `None` where the segment is too short for the common period.
fn compare(
    values: &[f64],
    rate_hz: f64,
    drive_hz: f64,
    segment: &RecordSegment,
    waveform: &Waveform,
) -> Option<WaveformDistance> {
    let segment_cycles = segment.period.cycles.unwrap_or(1) as u32;
    let common = least_common(segment_cycles, waveform.period_cycles).min(MAX_COMMON_PERIOD);
    let cycle = rate_hz / drive_hz;
    let piece_count = (values.len() as f64
        / (cycle * f64::from(common) * (MIN_PIECE_CYCLES / f64::from(common)).ceil()))
    .floor()
    .max(1.0);
    // Complete common periods, as many as fit.
    let cycles =
        (values.len() as f64 / piece_count / cycle / f64::from(common)).floor() * f64::from(common);
    let length = (cycles * cycle).round() as usize;
    if cycles < f64::from(common) || length == 0 || length > values.len() {
        return None;
    }
    let orders: Vec<u32> = (1..=MAX_ORDER * common)
        .filter(|j| f64::from(*j) / f64::from(common) * drive_hz < rate_hz / 2.0)
        .collect();
    let model: Vec<c64> = orders.iter().map(|j| waveform.at(*j, common)).collect();
    let (mut same, mut other, mut spectra) = (0.0, 0.0, 0.0);
    for piece in 0..piece_count as usize {
        let piece_values = &values[piece * length..(piece + 1) * length];
        let mean = piece_values.iter().sum::<f64>() / length as f64;
        let lines: Vec<c64> = orders
            .iter()
            .map(|j| {
                line(
                    piece_values,
                    mean,
                    f64::from(*j) / f64::from(common) * drive_hz / rate_hz,
                )
            })
            .collect();
        let total_power = lines.iter().map(|x| x.norm_sqr()).sum::<f64>();
        same += least_distance(&lines, &model, &orders, common, 1.0) / total_power;
        other += least_distance(&lines, &model, &orders, common, -1.0) / total_power;
        spectra += lines
            .iter()
            .zip(&model)
            .map(|(x, c)| (x.norm() - c.norm()).powi(2))
            .sum::<f64>()
            / total_power;
    }
    // A waveform of odd orders is its own mirror image half a period later: only a clear difference
    // determines the polarity.
    let inverted = other < POLARITY_RATIO * same;
    Some(WaveformDistance {
        waveform: (same.min(other) / piece_count).sqrt(),
        spectrum: (spectra / piece_count).sqrt(),
        inverted,
    })
}

fn least_common(a: u32, b: u32) -> u32 {
    let (mut x, mut y) = (a.max(1), b.max(1));
    while y > 0 {
        (x, y) = (y, x % y);
    }
    a.max(1) / x * b.max(1)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::segments;
    use super::*;
    use jounce_signal::RandomStream;
    use std::f64::consts::TAU;

    const HZ: f64 = 13.5;
    const RATE: f64 = 1536.0;

    fn solution(id: &str, period_cycles: u32, lines: &[(usize, f64, f64)]) -> Solution {
        let mut lines_v = vec![c64::new(0.0, 0.0); (MAX_ORDER * period_cycles) as usize];
        lines
            .iter()
            .for_each(|(k, amplitude, angle)| lines_v[k - 1] = c64::cis(*angle) * *amplitude);
        let waveform = Some(Waveform {
            period_cycles,
            lines_v,
        });
        Solution {
            id: id.to_owned(),
            period_cycles: Some(period_cycles),
            mean_power_w: 1.0,
            contacts: 0,
            share: 0.5,
            start: None,
            waveform,
        }
    }

    fn known() -> Vec<Solution> {
        let chaos = Solution {
            waveform: None,
            period_cycles: None,
            ..solution("chaos", 1, &[])
        };
        vec![
            solution("1a", 1, &[(1, 1.0, 0.0), (4, 0.3, 1.0)]),
            solution("3a", 3, &[(1, 0.6, 0.5), (3, 1.2, 2.0), (12, 0.4, -1.0)]),
            chaos,
        ]
    }

    /// A record of one waveform with another phase and, if requested, opposite polarity, `strength`
    /// times as large, with noise.
    fn record(waveform: &Waveform, strength: f64, noise: f64) -> Vec<f64> {
        let mut stream = RandomStream::new(8, 0);
        let value = |k: usize| {
            let cycles = k as f64 / RATE * HZ + 0.37;
            let line = |(j, c): (usize, &c64)| {
                (*c * c64::cis(TAU * (j + 1) as f64 / f64::from(waveform.period_cycles) * cycles))
                    .re
            };
            strength * waveform.lines_v.iter().enumerate().map(line).sum::<f64>()
        };
        (0..30_000)
            .map(|k| value(k) + noise * stream.normal_pair()[0])
            .collect()
    }

    fn found(values: &[f64], limit: f64) -> SegmentMatches {
        let samples = Samples::new(values, RATE).unwrap();
        let segmentation = segments(&samples, HZ).unwrap();
        assert_eq!(segmentation.segments.len(), 1);
        match_segments(&samples, HZ, &segmentation.segments[0], &known(), limit)
    }

    /// The waveform itself is at distance 0 (measured 1e-3: pieces have whole samples), one of 1.1
    /// times its size at 0.1 / 1.1, for any phase, polarity and noise.
    #[test]
    fn each_waveform_is_identified_at_its_distance() {
        for (k, id) in ["1a", "3a"].into_iter().enumerate() {
            let waveform = known()[k].waveform.clone().unwrap();
            for (strength, noise, expected_distance) in [
                (1.0, 0.0, 0.0),
                (-1.0, 0.0, 0.0),
                (1.1, 0.0, 0.1 / 1.1),
                (-1.1, 0.2, 0.1 / 1.1),
            ] {
                let matches = found(&record(&waveform, strength, noise), 0.2);
                let first = &matches.candidates[0];
                let distance = first.waveform_distance.unwrap();
                assert_eq!(
                    (matches.id(), first.inverted),
                    (Some(id), strength < 0.0),
                    "{matches:?}"
                );
                eprintln!(
                    "{id}, {strength}, noise {noise}: {distance:.4}, exact {expected_distance:.4}"
                );
                assert!(
                    (distance - expected_distance).abs() < if noise > 0.0 { 0.02 } else { 3e-3 },
                    "{distance} {expected_distance}"
                );
                assert!(
                    noise > 0.0
                        || (first.power_ratio.unwrap() / strength.powi(2) - 1.0).abs() < 1e-3,
                    "{first:?}"
                );
            }
        }
    }

    /// A waveform 1.5 times as large, another waveform, chaos: no solution fits. Two equally near:
    /// several.
    #[test]
    fn unknown_waveforms_match_no_solution() {
        let waveform = known()[0].waveform.clone().unwrap();
        assert_eq!(
            found(&record(&waveform, 1.5, 0.0), 0.2).fits,
            SegmentMatch::None
        );
        let other = solution("", 2, &[(1, 1.0, 0.0), (3, 1.0, 0.0)])
            .waveform
            .unwrap();
        assert_eq!(
            found(&record(&other, 1.0, 0.0), 0.2).fits,
            SegmentMatch::None
        );
        let mut stream = RandomStream::new(3, 0);
        let noise: Vec<f64> = (0..30_000).map(|_| stream.normal_pair()[0]).collect();
        let matches = found(&noise, 0.2);
        assert!(
            matches.fits == SegmentMatch::None
                && matches
                    .candidates
                    .iter()
                    .all(|c| c.waveform_distance.is_none()),
            "{matches:?}"
        );
        let samples_of = record(&waveform, 1.0, 0.0);
        let samples = Samples::new(&samples_of, RATE).unwrap();
        let segmentation = segments(&samples, HZ).unwrap();
        let equal_solutions = [known().swap_remove(0), known().swap_remove(0)];
        assert_eq!(
            match_segments(
                &samples,
                HZ,
                &segmentation.segments[0],
                &equal_solutions,
                0.2
            )
            .fits,
            SegmentMatch::Several
        );
    }
}
