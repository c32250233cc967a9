//! Band of the power of an orbit over a key, under tolerances.
//!
//! The orbit is followed to each drawn design at the value of the key where it is known, and from
//! there over the key to both sides, until it is lost. Where several draws still have it, their
//! quantiles are the band. Newton's method may find another orbit than the one that is followed; a
//! jump of the power that shorter steps do not divide shows it, and the orbit is lost there too.

use super::quantile;
use crate::problem::Tolerance;
use crate::result::PowerBand;
use crate::search::{Followed, Places};
use jounce_analysis::{AnalysisError, KnownOrbit, Model};
use jounce_spec::NumericKey;
use rayon::prelude::*;

/// Shares of the quantiles: the lower end of the band, its middle, and the upper end.
const SHARES: [f64; 3] = [0.05, 0.5, 0.95];

/// Largest change of the logarithm of the power in one step.
const LARGEST_STEP: f64 = 0.7;

/// Largest number of times that a step is halved.
const MAX_HALVINGS: u32 = 4;

/// A band of the power over a key.
#[derive(Debug)]
pub struct PowerBandSearch<'p> {
    /// Model; its value of the key does not matter.
    pub base: &'p Model,
    /// The key.
    pub key: &'p NumericKey,
    /// Its values, SI, ascending.
    pub values: Vec<f64>,
    /// Orbit at one value of the key.
    pub orbit: KnownOrbit,
    /// Tolerances. One of the key itself scatters about each value.
    pub tolerances: &'p [Tolerance],
    /// Number of drawn designs.
    pub draws: usize,
    /// Seed of the draws.
    pub seed: u64,
}

impl PowerBandSearch<'_> {
    /// Computes the band. The control of the model counts the drawn designs.
    ///
    /// # Errors
    /// A key or a model that does not exist at the orbit.
    pub fn run(&self) -> Result<PowerBand, AnalysisError> {
        let control = &self.base.kernel.control;
        control.expect(self.draws);
        let mut spec = self.base.spec.clone();
        self.key.set(&mut spec, self.orbit.parameter)?;
        let model = self.base.changed(spec)?;
        let start = Followed::near(model, self.orbit.period_cycles, &self.orbit.state);
        let rows = Places::new(self.tolerances.len(), self.seed).take(self.draws);
        let drawn: Vec<Vec<Option<f64>>> = rows
            .par_iter()
            .map(|row| {
                let powers_w = start.as_ref().map(|start| self.drawn(start, row));
                control.count();
                powers_w.unwrap_or_else(|| vec![None; self.values.len()])
            })
            .collect();
        let mut band = PowerBand {
            parameter: self.values.clone(),
            ..PowerBand::default()
        };
        for index in 0..self.values.len() {
            let mut powers_w: Vec<f64> = drawn.iter().filter_map(|own| own[index]).collect();
            powers_w.sort_by(f64::total_cmp);
            let [low_w, median_w, high_w] = SHARES.map(|share| quantile(&powers_w, share));
            band.low_w.push(low_w);
            band.median_w.push(median_w);
            band.high_w.push(high_w);
            band.found_share
                .push(powers_w.len() as f64 / self.draws as f64);
        }
        Ok(band)
    }

    /// Returns the power of a drawn design at each value of the key, W; `None` where it has lost
    /// the orbit.
    fn drawn(&self, start: &Followed, row: &[f64]) -> Vec<Option<f64>> {
        let mut powers_w = vec![None; self.values.len()];
        let known = self.orbit.parameter;
        let Some(first) = start.to(&self.values_at(start, known, row)) else {
            return powers_w;
        };
        let middle = self.values.partition_point(|value| *value < known);
        let up: Vec<usize> = (middle..self.values.len()).collect();
        let down: Vec<usize> = (0..middle).rev().collect();
        for side in [up, down] {
            let (mut last, mut from): (Option<Followed>, f64) = (None, known);
            for index in side {
                let here = last.as_ref().unwrap_or(&first);
                let to = |value: f64| self.values_at(start, value, row);
                let Some(next) = followed(here, (from, self.values[index]), &to, MAX_HALVINGS)
                else {
                    break;
                };
                powers_w[index] = Some(next.orbit.mean_power_w);
                (last, from) = (Some(next), self.values[index]);
            }
        }
        powers_w
    }

    /// Returns the values of a drawn design at a value of the key; `start` has the values from which
    /// the tolerances deviate.
    fn values_at(&self, start: &Followed, value: f64, row: &[f64]) -> Vec<(&NumericKey, f64)> {
        let mut values = vec![(self.key, value)];
        for (tolerance, place) in self.tolerances.iter().zip(row) {
            let deviation = tolerance.deviation(*place);
            match tolerance.key.path() == self.key.path() {
                true => values[0].1 += deviation,
                false => {
                    let nominal = tolerance.key.get(&start.model.spec);
                    values.push((&tolerance.key, nominal.unwrap_or(f64::NAN) + deviation));
                }
            }
        }
        values
    }
}

/// Follows an orbit over a key, in shorter steps where its power changes by much.
fn followed<'k>(
    here: &Followed,
    (from, to): (f64, f64),
    values_at: &dyn Fn(f64) -> Vec<(&'k NumericKey, f64)>,
    halvings: u32,
) -> Option<Followed> {
    let next = here.to(&values_at(to))?;
    let step = (next.orbit.mean_power_w / here.orbit.mean_power_w).ln();
    if step.abs() < LARGEST_STEP {
        return Some(next);
    }
    let halvings = halvings.checked_sub(1)?;
    let middle = 0.5 * (from + to);
    let half = followed(here, (from, middle), values_at, halvings)?;
    followed(&half, (middle, to), values_at, halvings)
}
