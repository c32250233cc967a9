//! Peak voltage of each load and patch, peak strain of each patch and peak displacement of each
//! named point at the end of a run.
//!
//! ```text
//! V_peak = max |V(t)|,   V = c (y(t) + steady(t)) + V_zero
//! ```
//!
//! `c` is the row of a voltage, strain or displacement in block coordinates, `y` the recorded state,
//! which is exact at any time. `V_zero` is 0 without diodes. The strain of a patch is the largest of
//! its outer face; a displacement is relative to the base of its body. The window is that of
//! [`RunResult::peak_window_s`].
//!
//! Validation: `crates/jounce-analysis/tests/integrate/circuits/voltage_peak.rs`, 5e-16 of the
//! closed form without contact; with impacts a hundred thousand samples find no higher value.

use super::RunResult;
use super::extremes::RecordWindow;
use super::output_row::{OutputRow, OutputSource};
use jounce_dynamics::Kernel;

/// Peaks of the outputs, zero to peak; NaN without a record of the averaging window.
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

/// Returns the peaks of the averaging window of a run; NaN without a record of it.
pub fn output_peaks(kernel: &Kernel, result: &RunResult) -> OutputPeaks {
    let plant = &kernel.plant;
    let modes = &plant.system.modes;
    let (loads, patches) = (plant.system.loads.len(), modes.patch.len());
    let window = RecordWindow::of(plant, &result.trajectory, result.peak_window_s);
    let Some(window) = window.filter(|window| window.is_of(result.peak_window_s)) else {
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
    let extremes = window.extremes(kernel, &result.trajectory, &sources);
    let size = |[lowest, highest]: [f64; 2]| highest.max(-lowest);
    let mut peaks: Vec<f64> = extremes.into_iter().map(size).collect();
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
