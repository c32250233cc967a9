//! Peak voltage of each load and patch, peak strain of each patch and peak displacement of each
//! named point at the end of a run.
//!
//! ```text
//! V_peak = max |V(t)|,   V = c (y(t) + steady(t)) + V_zero
//! ```
//!
//! `c` is the row of a voltage, strain or displacement in block coordinates, `y` the recorded state,
//! which is exact at any time. `V_zero` is 0 without diodes. The strain of a patch is the largest of
//! its outer face; a displacement is relative to the base of its body. The record is sampled 256
//! times per drive cycle. The highest samples are refined by parabolic interpolation.
//!
//! The window is one period of the orbit if the run has settled, else the last eight drive cycles.
//! If the drives are not periodic, it is the complete record.
//!
//! Validation: `tests/integrate/circuits/voltage_peak.rs`, 5e-16 of the closed form without contact; with
//! impacts a hundred thousand samples find no higher value.

use super::output_row::{OutputRow, OutputSource};
use super::{RunPlan, RunResult};
use jounce_dynamics::{Kernel, Trajectory};
use jounce_model::plant::Plant;

/// Drive cycles of the window if a run has not settled.
const UNSETTLED_CYCLES: f64 = 8.0;
/// Samples per drive cycle.
const SAMPLES_PER_CYCLE: f64 = 256.0;
/// Fewest samples of a complete record.
const MIN_SAMPLES: f64 = 4096.0;
/// Number of peaks that are refined, ...
const REFINED_PEAKS: usize = 3;
/// ... and number of refinement samples of each.
const REFINED_SAMPLES: usize = 12;
/// Smallest distance of two samples, relative to the bracket.
const MIN_SAMPLE_SPACING: f64 = 1e-5;
/// Golden-section fraction at which the bracket is divided if the parabola is unusable.
const GOLDEN_SHARE: f64 = 0.381_966_011_250_105_1;

/// Peaks of the outputs, zero to peak; NaN without a record.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OutputPeaks {
    /// Voltage across the resistor of each load, V, in the order of the loads.
    pub loads_v: Vec<f64>,
    /// Voltage of each patch, V, in the order of the patches of the plant.
    pub patches_v: Vec<f64>,
    /// Strain of each patch; NaN for one of a structure given by its modes.
    pub strains: Vec<f64>,
    /// Displacement of each named point, m, in the order of the shapes of the plant.
    pub points_m: Vec<f64>,
}

impl OutputPeaks {
    /// Returns the voltage of the first load, or of the first patch without a load; `None` without
    /// either or without a record.
    pub fn first_v(&self) -> Option<f64> {
        self.loads_v
            .first()
            .or(self.patches_v.first())
            .copied()
            .filter(|peak_v| peak_v.is_finite())
    }
}

/// Returns the peaks at the end of a run; NaN if the drives are not periodic and the plan has no
/// record.
pub fn output_peaks(kernel: &Kernel, result: &RunResult, plan: &RunPlan) -> OutputPeaks {
    let plant = &kernel.plant;
    let modes = &plant.system.modes;
    let (loads, patches) = (plant.system.loads.len(), modes.patch.len());
    let Some(window) = RecordWindow::of(plant, result, plan) else {
        let none = |count: usize| vec![f64::NAN; count];
        return OutputPeaks {
            loads_v: none(loads),
            patches_v: none(patches),
            strains: none(patches),
            points_m: none(modes.shape.len()),
        };
    };
    // A load across a patch has the voltage of the patch.
    let same_patch = |load: usize| {
        let row = OutputRow::of(plant, OutputSource::Load(load));
        (0..patches).find(|patch| OutputRow::of(plant, OutputSource::Patch(*patch)) == row)
    };
    let single = |source: OutputSource| vec![source];
    let mut sources: Vec<Vec<OutputSource>> =
        (0..patches).map(OutputSource::Patch).map(single).collect();
    let of_loads: Vec<usize> = (0..loads)
        .map(|load| {
            same_patch(load).unwrap_or_else(|| {
                sources.push(single(OutputSource::Load(load)));
                sources.len() - 1
            })
        })
        .collect();
    let voltages = sources.len();
    sources.extend(modes.patch.values().enumerate().map(|(patch, own)| {
        let places = 0..own.strain.len();
        places
            .map(|place| OutputSource::Strain(patch, place))
            .collect()
    }));
    sources.extend((0..modes.shape.len()).map(OutputSource::Point).map(single));
    let mut peaks = window.peaks(kernel, &result.trajectory, &sources);
    let points_m = peaks.split_off(voltages + patches);
    let strains = peaks.split_off(voltages);
    let loads_v = of_loads.into_iter().map(|index| peaks[index]).collect();
    peaks.truncate(patches);
    OutputPeaks {
        loads_v,
        patches_v: peaks,
        strains,
        points_m,
    }
}

/// Window of a record that is sampled.
struct RecordWindow {
    begin_s: f64,
    end_s: f64,
    /// Longest time between two samples, s.
    gap_s: f64,
}

impl RecordWindow {
    fn of(plant: &Plant, result: &RunResult, plan: &RunPlan) -> Option<Self> {
        let (record_start_s, end_s) = (
            result.trajectory.segments().first()?.start_s,
            plan.duration_s,
        );
        let Some(period_s) = plant.period_s() else {
            return Some(Self {
                begin_s: record_start_s,
                end_s,
                gap_s: (end_s - record_start_s) / MIN_SAMPLES,
            });
        };
        let settled = result.settlement.filter(|settlement| settlement.settled);
        let cycles = settled.map_or(UNSETTLED_CYCLES, |settlement| {
            f64::from(settlement.period_cycles)
        });
        let fastest = plant
            .tones
            .iter()
            .map(|tone| tone.angular_frequency_rad_s)
            .fold(0.0, f64::max);
        Some(Self {
            begin_s: record_start_s.max(end_s - cycles * period_s),
            end_s,
            gap_s: std::f64::consts::TAU / fastest / SAMPLES_PER_CYCLE,
        })
    }

    /// Returns the peak of each output: the largest of its sources, NaN without one.
    fn peaks(
        &self,
        kernel: &Kernel,
        trajectory: &Trajectory,
        sources: &[Vec<OutputSource>],
    ) -> Vec<f64> {
        let segments = trajectory.segments();
        // Step in which the window begins.
        let first = segments
            .partition_point(|segment| segment.start_s <= self.begin_s)
            .saturating_sub(1);
        let rows_of = |plant: &Plant| -> Vec<OutputRow> {
            let rows = sources.iter().flatten();
            rows.map(|source| OutputRow::of(plant, *source)).collect()
        };
        let rows = rows_of(&kernel.plant);
        let sizes = |time_s: f64| -> Vec<f64> {
            let states = trajectory.at(kernel, &[time_s]);
            let size =
                |row: &OutputRow| states.first().map_or(0.0, |at| row.size(time_s, &at.state));
            rows.iter().map(size).collect()
        };
        let mut peaks: Vec<Peaks> = sizes(self.begin_s)
            .into_iter()
            .map(|size| Peaks::starting_at((self.begin_s, size)))
            .collect();
        let mut known: Vec<(&Kernel, Vec<OutputRow>)> = Vec::new();
        trajectory.walk(
            kernel,
            first,
            self.gap_s,
            &mut |state_kernel, time_s, state| {
                let is_this = |(known, _): &(&Kernel, _)| std::ptr::eq(*known, state_kernel);
                let index = known.iter().position(is_this).unwrap_or_else(|| {
                    known.push((state_kernel, rows_of(&state_kernel.plant)));
                    known.len() - 1
                });
                if time_s > self.begin_s {
                    for (peaks, row) in peaks.iter_mut().zip(&known[index].1) {
                        peaks.add((time_s, row.size(time_s, state)));
                    }
                }
            },
        );
        for (peaks, size) in peaks.iter_mut().zip(sizes(self.end_s)) {
            peaks.add((self.end_s, size));
        }
        let mut with_rows = rows.iter().zip(peaks);
        let peak = |group: &Vec<OutputSource>| {
            let own = with_rows.by_ref().take(group.len());
            // Only the place with the highest sample is refined.
            let highest = own.max_by(|(_, a), (_, b)| a.highest().total_cmp(&b.highest()));
            highest.map_or(f64::NAN, |(row, peaks)| {
                peaks.largest(&|time_s| {
                    let states = trajectory.at(kernel, &[time_s]);
                    states.first().map_or(0.0, |at| row.size(time_s, &at.state))
                })
            })
        };
        sources.iter().map(peak).collect()
    }
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
        let top = self.tops.first().map_or(0.0, |top| top[1].1);
        top.max(self.first).max(self.last.1)
    }

    /// Returns the largest of the first and last samples and the refined local maxima.
    fn largest(self, value: &impl Fn(f64) -> f64) -> f64 {
        let refined = self.tops.into_iter().map(|top| highest(top, value));
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
