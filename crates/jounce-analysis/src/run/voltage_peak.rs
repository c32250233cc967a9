//! Peak voltage of each load and patch at the end of a run.
//!
//! ```text
//! V_peak = max |V(t)|,   V = c (y(t) + steady(t)) + V_zero
//! ```
//!
//! `c` (V) is the row of the voltage in block coordinates, `y` the recorded state, which is exact
//! at any time. The record is sampled 256 times per drive cycle. The highest samples are refined by
//! parabolic interpolation.
//!
//! The window is one period of the orbit if the run has settled, else the last eight drive cycles.
//! If the drives are not periodic, it is the complete record.
//!
//! Validation: `tests/integrate/circuits/voltage_peak.rs`, 5e-16 of the closed form without contact; with
//! impacts a hundred thousand samples find no higher value.

use super::{RunPlan, RunResult};
use jounce_dynamics::{Kernel, Trajectory};
use jounce_linalg::c64;
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

/// Peak voltages, zero to peak, V.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct VoltagePeaks {
    /// Peak across the resistor of each load, in the order of the loads.
    pub loads_v: Vec<f64>,
    /// Peak of each patch, in the order of the patches of the plant.
    pub patches_v: Vec<f64>,
}

impl VoltagePeaks {
    /// Returns the peak of the first load, or of the first patch without a load; `None` without
    /// either or without a record.
    pub fn first_v(&self) -> Option<f64> {
        self.loads_v
            .first()
            .or(self.patches_v.first())
            .copied()
            .filter(|peak_v| peak_v.is_finite())
    }
}

/// Returns the peak voltages at the end of a run; NaN if the drives are not periodic and the plan
/// has no record.
pub fn voltage_peaks(kernel: &Kernel, result: &RunResult, plan: &RunPlan) -> VoltagePeaks {
    let plant = &kernel.plant;
    let Some(window) = RecordWindow::of(plant, result, plan) else {
        let none = |count: usize| vec![f64::NAN; count];
        return VoltagePeaks {
            loads_v: none(plant.system.loads.len()),
            patches_v: none(plant.system.modes.patch.len()),
        };
    };
    let patches = plant.system.modes.patch.len();
    // A load across a patch has the voltage of the patch.
    let same_patch = |load: usize| {
        let row = VoltageRow::of(plant, VoltageSource::Load(load));
        (0..patches).find(|patch| VoltageRow::of(plant, VoltageSource::Patch(*patch)) == row)
    };
    let mut sources: Vec<VoltageSource> = (0..patches).map(VoltageSource::Patch).collect();
    let of_loads: Vec<usize> = (0..plant.system.loads.len())
        .map(|load| {
            same_patch(load).unwrap_or_else(|| {
                sources.push(VoltageSource::Load(load));
                sources.len() - 1
            })
        })
        .collect();
    let mut patches_v = window.peaks_v(kernel, &result.trajectory, &sources);
    let loads_v = of_loads.into_iter().map(|index| patches_v[index]).collect();
    patches_v.truncate(patches);
    VoltagePeaks { loads_v, patches_v }
}

/// Source of a voltage.
#[derive(Debug, Clone, Copy)]
enum VoltageSource {
    /// Across the resistor of a load.
    Load(usize),
    /// Across a patch.
    Patch(usize),
}

/// Output row of a voltage in block coordinates.
#[derive(Debug, PartialEq)]
struct VoltageRow {
    row: Vec<f64>,
    /// Angular frequency of each tone, rad/s, and complex amplitude of its voltage, V.
    steady: Vec<(f64, c64)>,
    zero_v: f64,
}

impl VoltageRow {
    fn of(plant: &Plant, source: VoltageSource) -> Self {
        let electrical = &plant.electrical;
        let (row, zero_v) = match source {
            VoltageSource::Load(load) => (plant.load_voltage_row(load), 0.0),
            VoltageSource::Patch(patch) => {
                let zeros_v = electrical.patch[patch]
                    .iter()
                    .map(|(node, factor)| factor * electrical.zero_v[*node]);
                (plant.voltage_row(patch), zeros_v.sum())
            }
        };
        let steady = plant
            .tones
            .iter()
            .map(|tone| tone.angular_frequency_rad_s)
            .zip(plant.steady_output(&row))
            .collect();
        Self {
            row,
            steady,
            zero_v,
        }
    }

    /// Magnitude of the voltage, V.
    fn size_v(&self, time_s: f64, state: &[f64]) -> f64 {
        let free_v: f64 = self.row.iter().zip(state).map(|(c, y)| c * y).sum();
        let steady_v: f64 = self
            .steady
            .iter()
            .map(|(w, amplitude)| (c64::cis(w * time_s) * amplitude).re)
            .sum();
        (free_v + steady_v + self.zero_v).abs()
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

    /// Returns the peak of each voltage.
    fn peaks_v(
        &self,
        kernel: &Kernel,
        trajectory: &Trajectory,
        sources: &[VoltageSource],
    ) -> Vec<f64> {
        let segments = trajectory.segments();
        // Step in which the window begins.
        let first = segments
            .partition_point(|segment| segment.start_s <= self.begin_s)
            .saturating_sub(1);
        let rows_of = |plant: &Plant| -> Vec<VoltageRow> {
            let rows = sources.iter().map(|source| VoltageRow::of(plant, *source));
            rows.collect()
        };
        let rows = rows_of(&kernel.plant);
        let size_v = |row: &VoltageRow, time_s: f64| {
            trajectory
                .at(kernel, &[time_s])
                .first()
                .map_or(0.0, |at| row.size_v(time_s, &at.state))
        };
        let mut peaks: Vec<Peaks> = rows
            .iter()
            .map(|row| Peaks::starting_at((self.begin_s, size_v(row, self.begin_s))))
            .collect();
        let mut known: Vec<(&Kernel, Vec<VoltageRow>)> = Vec::new();
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
                        peaks.add((time_s, row.size_v(time_s, state)));
                    }
                }
            },
        );
        let peak_v = |(row, mut peaks): (&VoltageRow, Peaks)| {
            peaks.add((self.end_s, size_v(row, self.end_s)));
            peaks.largest(&|time_s| size_v(row, time_s))
        };
        rows.iter().zip(peaks).map(peak_v).collect()
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
