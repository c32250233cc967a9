//! Smallest and largest values of outputs over a window of a record.
//!
//! The record is sampled 256 times per drive cycle, without a period of the drives 4096 times. The
//! highest and lowest samples are refined by parabolic interpolation.

use super::output_row::{OutputRow, OutputSource};
use jounce_dynamics::{Kernel, Trajectory};
use jounce_linalg::c64;
use jounce_model::plant::Plant;

/// Samples per drive cycle.
const SAMPLES_PER_CYCLE: f64 = 256.0;
/// Fewest samples of a window.
const MIN_SAMPLES: f64 = 4096.0;
/// Number of peaks that are refined, ...
const REFINED_PEAKS: usize = 3;
/// ... and number of refinement samples of each.
const REFINED_SAMPLES: usize = 12;
/// Smallest distance of two samples, relative to the bracket.
const MIN_SAMPLE_SPACING: f64 = 1e-5;
/// Golden-section fraction at which the bracket is divided if the parabola is unusable.
const GOLDEN_SHARE: f64 = 0.381_966_011_250_105_1;

/// Window at the end of a record.
pub(super) struct RecordWindow {
    begin_s: f64,
    end_s: f64,
    /// Longest time between two samples, s.
    gap_s: f64,
}

impl RecordWindow {
    /// Returns the last `length_s` of a record, or all of a shorter one; `None` for an empty record.
    pub fn of(plant: &Plant, trajectory: &Trajectory, length_s: f64) -> Option<Self> {
        let (first, last) = (
            trajectory.segments().first()?,
            trajectory.segments().last()?,
        );
        let end_s = last.start_s + last.length_s;
        let begin_s = first.start_s.max(end_s - length_s);
        let tones = plant.tones.iter();
        let fastest = tones.fold(0.0, |max: f64, tone| max.max(tone.angular_frequency_rad_s));
        let gap_s = match plant.period_s() {
            Some(_) => std::f64::consts::TAU / fastest / SAMPLES_PER_CYCLE,
            None => (end_s - begin_s) / MIN_SAMPLES,
        };
        Some(Self {
            begin_s,
            end_s,
            gap_s,
        })
    }

    /// True where the record is not shorter than a window.
    pub fn is_of(&self, length_s: f64) -> bool {
        self.end_s - self.begin_s >= length_s * (1.0 - 1e-9)
    }

    /// Returns the smallest and the largest value of each output over its sources; NaN without a
    /// source.
    pub fn extremes(
        &self,
        kernel: &Kernel,
        trajectory: &Trajectory,
        sources: &[Vec<OutputSource>],
    ) -> Vec<[f64; 2]> {
        let of_plant = |plant: &Plant| -> Vec<OutputRow> {
            let rows = sources.iter().flatten();
            rows.map(|source| OutputRow::of(plant, *source)).collect()
        };
        let rows = of_plant(&kernel.plant);
        let mut series = self.series(kernel, trajectory, &rows, of_plant).into_iter();
        let at = |row: &OutputRow, time_s: f64| value(kernel, trajectory, row, time_s);
        let mut rows = rows.iter();
        let extremes = |group: &Vec<OutputSource>| {
            let (mut lowest, mut highest) = (f64::NAN, f64::NAN);
            let own: Vec<_> = rows
                .by_ref()
                .zip(series.by_ref())
                .take(group.len())
                .collect();
            // Only the source with the highest sample is refined.
            let most = |sign: usize| {
                own.iter()
                    .max_by(|a, b| a.1[sign].highest().total_cmp(&b.1[sign].highest()))
            };
            if let Some((row, peaks)) = most(0) {
                highest = peaks[0].largest(&|time_s| at(row, time_s));
            }
            if let Some((row, peaks)) = most(1) {
                lowest = -peaks[1].largest(&|time_s| -at(row, time_s));
            }
            [lowest, highest]
        };
        sources.iter().map(extremes).collect()
    }

    /// Returns the peaks of each output and of its negative.
    fn series(
        &self,
        kernel: &Kernel,
        trajectory: &Trajectory,
        rows: &[OutputRow],
        of_plant: impl Fn(&Plant) -> Vec<OutputRow>,
    ) -> Vec<[Peaks; 2]> {
        // Step in which the window begins.
        let first = trajectory
            .segments()
            .partition_point(|segment| segment.start_s <= self.begin_s)
            .saturating_sub(1);
        let at = |row: &OutputRow, time_s: f64| value(kernel, trajectory, row, time_s);
        let start = |row: &OutputRow| {
            let first = at(row, self.begin_s);
            [first, -first].map(|value| Peaks::starting_at((self.begin_s, value)))
        };
        let mut series: Vec<[Peaks; 2]> = rows.iter().map(start).collect();
        let mut known: Vec<(&Kernel, Vec<OutputRow>)> = Vec::new();
        let mut phasors: Vec<c64> = Vec::new();
        trajectory.walk(
            kernel,
            first,
            self.gap_s,
            &mut |state_kernel, time_s, state| {
                if time_s <= self.begin_s {
                    return;
                }
                let is_this = |(known, _): &(&Kernel, _)| std::ptr::eq(*known, state_kernel);
                let index = known.iter().position(is_this).unwrap_or_else(|| {
                    known.push((state_kernel, of_plant(&state_kernel.plant)));
                    known.len() - 1
                });
                OutputRow::phasors(&state_kernel.plant, time_s, &mut phasors);
                for ([high, low], row) in series.iter_mut().zip(&known[index].1) {
                    let value = row.value(&phasors, state);
                    high.add((time_s, value));
                    low.add((time_s, -value));
                }
            },
        );
        for ([high, low], row) in series.iter_mut().zip(rows) {
            let last = at(row, self.end_s);
            high.add((self.end_s, last));
            low.add((self.end_s, -last));
        }
        series
    }
}

/// Returns an output at a time of a record.
fn value(kernel: &Kernel, trajectory: &Trajectory, row: &OutputRow, time_s: f64) -> f64 {
    let mut phasors = Vec::new();
    OutputRow::phasors(&kernel.plant, time_s, &mut phasors);
    let states = trajectory.at(kernel, &[time_s]);
    let first = states.first();
    first.map_or(0.0, |at| row.value(&phasors, &at.state))
}

/// Highest samples `(time, value)` of a series.
struct Peaks {
    /// Value of the first sample.
    first: f64,
    /// Last sample, and the one before it.
    last: (f64, f64),
    before: Option<(f64, f64)>,
    /// Highest local maxima, the highest first, each with its neighbours.
    tops: Vec<[(f64, f64); 3]>,
}

impl Peaks {
    fn starting_at(first: (f64, f64)) -> Self {
        Self {
            first: first.1,
            last: first,
            before: None,
            tops: Vec::new(),
        }
    }

    fn add(&mut self, sample: (f64, f64)) {
        let middle = std::mem::replace(&mut self.last, sample);
        let Some(before) = self.before.replace(middle) else {
            return;
        };
        if before.1 <= middle.1 && middle.1 >= sample.1 {
            let lower = |top: &[(f64, f64); 3]| top[1].1 >= middle.1;
            let place = self.tops.partition_point(lower);
            self.tops.insert(place, [before, middle, sample]);
            self.tops.truncate(REFINED_PEAKS);
        }
    }

    /// Returns the highest sample.
    fn highest(&self) -> f64 {
        let top = self.tops.first().map_or(self.first, |top| top[1].1);
        top.max(self.first).max(self.last.1)
    }

    /// Returns the largest of the first and last samples and the refined local maxima.
    fn largest(&self, value: &impl Fn(f64) -> f64) -> f64 {
        let refined = self.tops.iter().map(|top| highest(*top, value));
        refined.fold(self.first.max(self.last.1), f64::max)
    }
}

/// Returns the maximum near the middle of three samples `(time, value)`, where the middle one is
/// the highest. Each new sample is at the vertex of the parabola through the three.
fn highest([mut from, mut top, mut to]: [(f64, f64); 3], value: &impl Fn(f64) -> f64) -> f64 {
    for _ in 0..REFINED_SAMPLES {
        let (left, right) = (top.0 - from.0, to.0 - top.0);
        let (fall, rise) = ((from.1 - top.1) / left, (to.1 - top.1) / right);
        let parabola = top.0 + 0.5 * (left * rise - right * fall) / -(fall + rise);
        let spacing = MIN_SAMPLE_SPACING * (to.0 - from.0);
        let divided = if left > right {
            top.0 - GOLDEN_SHARE * left
        } else {
            top.0 + GOLDEN_SHARE * right
        };
        let uses_parabola = parabola > from.0 + spacing
            && parabola < to.0 - spacing
            && (parabola - top.0).abs() > spacing;
        let time_s = if uses_parabola { parabola } else { divided };
        let sample = (time_s, value(time_s));
        let (inner, outer) = if sample.1 >= top.1 {
            (sample, top)
        } else {
            (top, sample)
        };
        if outer.0 < inner.0 {
            from = outer;
        } else {
            to = outer;
        }
        top = inner;
    }
    top.1
}
