//! Contribution of signals (drives that are linear in time between breakpoints) to an energy meter.
//!
//! Under signals `u_s` with columns `b_s` the state obeys `y' = A y + b f + sum_s b_s u_s`. The
//! boundary terms of the meter (see [`crate::plant::EnergyMeter`]) therefore change by
//!
//! ```text
//! d(-y^T P y) = power - 2 y^T P b_s u_s dt - ..,     d(e^{i w t} r y) = .. + e^{i w t} r b_s u_s dt
//! ```
//!
//! and a signal contributes only `integral u_s y dt` and `integral u_s e^{i w t} dt`, which are
//! common to all meters.

use crate::plant::{Plant, dot};
use jounce_linalg::c64;

/// Integrals of all signals since the start of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SignalIntegrals {
    /// Per signal: `integral u y dt`, block coordinates.
    pub states: Vec<Vec<f64>>,
    /// Per signal and tone: `integral u e^{i w t} dt`.
    pub tones: Vec<Vec<c64>>,
}

/// Factors of the integrals.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SignalMeter {
    /// Per signal: row on `integral u y dt`.
    rows: Vec<Vec<f64>>,
    /// Per signal and tone: factor of `integral u e^{i w t} dt`.
    tones: Vec<Vec<c64>>,
}

impl SignalMeter {
    /// `rows` and `tones` are the terms of the power itself that contain a signal; `product` is the
    /// product of the signal with the `P` of the meter, `tone_rows` are its `r`.
    pub(in crate::plant) fn new(
        plant: &Plant,
        (rows, tones): (Vec<Vec<f64>>, Vec<Vec<c64>>),
        product: impl Fn(&[f64]) -> Vec<f64>,
        tone_rows: &[&[c64]],
    ) -> Self {
        let row = |(direct, forcing): (Vec<f64>, &crate::plant::Forcing)| {
            direct
                .iter()
                .zip(product(&forcing.column))
                .map(|(direct, pb)| direct + 2.0 * pb)
                .collect()
        };
        let tone = |(direct, forcing): (Vec<c64>, &crate::plant::Forcing)| {
            direct
                .iter()
                .zip(tone_rows)
                .map(|(direct, r)| direct - dot(&forcing.column, r))
                .collect()
        };
        Self {
            rows: rows.into_iter().zip(&plant.forcings).map(row).collect(),
            tones: tones.into_iter().zip(&plant.forcings).map(tone).collect(),
        }
    }

    /// Returns the energy, J, that the signals add to the boundary terms and contact terms of the
    /// meter.
    pub fn energy_j(&self, integrals: &SignalIntegrals) -> f64 {
        let states = self
            .rows
            .iter()
            .zip(&integrals.states)
            .map(|(row, y)| row.iter().zip(y).map(|(r, y)| r * y).sum::<f64>());
        let tones = self
            .tones
            .iter()
            .flatten()
            .zip(integrals.tones.iter().flatten())
            .map(|(factor, phasor)| (factor * phasor).re);
        states.sum::<f64>() + tones.sum::<f64>()
    }
}
