//! Figures 8 and 9: mean power over the load resistance, with and without impact.
//!
//! Every resistance is a separate run from rest; without impact the power is the closed form.

use crate::harvester::{PaperCase, PaperHarvester};
use crate::named::NamedStop;
use crate::{NamedFigure, NamedTable, ReproduceError};
use jounce_io::table::{Column, Table};
use jounce_model::linear::{Optimum, optimal_resistance, steady_power_w};
use jounce_plot::{LineDirection, SweepLine, power_against_resistance};
use rayon::prelude::*;

/// Resistances per decade of the line without impact.
const LINE_PER_DECADE: u32 = 60;

/// Resistances per decade with impact.
const PER_DECADE: u32 = 10;

/// Data of one of the two figures.
pub(crate) struct PowerOverResistance {
    pub case: PaperCase,
    pub resistance_ohm: Vec<f64>,
    pub impact_w: Vec<f64>,
    pub settled: Vec<bool>,
    pub linear_w: Vec<f64>,
    /// Resistances, ohm, and powers, W, of the line without impact.
    linear_line: (Vec<f64>, Vec<f64>),
    /// Optimal load without impact, closed form.
    pub linear_best: Optimum,
    /// Optimal load with impact: maximum of the parabola over `ln R` through the highest point and
    /// its neighbours.
    pub impact_best_ohm: f64,
}

impl PowerOverResistance {
    /// Computes 10 kohm to 10 Mohm at the drive of a case.
    pub fn compute(harvester: &PaperHarvester, case: PaperCase) -> Result<Self, ReproduceError> {
        let resistance_ohm = resistances_ohm(PER_DECADE);
        let at = |resistance_ohm: &f64| PaperCase {
            resistance_ohm: *resistance_ohm,
            ..case
        };
        harvester.control.expect(resistance_ohm.len());
        let counted = |r| harvester.run(at(r)).inspect(|_| harvester.control.count());
        let results = resistance_ohm
            .par_iter()
            .map(counted)
            .collect::<Result<Vec<_>, _>>()?;
        let line_ohm = resistances_ohm(LINE_PER_DECADE);
        let linear = |ohm: &[f64]| {
            ohm.iter()
                .map(|r| Ok(steady_power_w(&harvester.plant(at(r))?)))
                .collect::<Result<Vec<f64>, ReproduceError>>()
        };
        let (linear_w, line_w) = (linear(&resistance_ohm)?, linear(&line_ohm)?);
        let impact_w: Vec<f64> = results.iter().map(|result| result.mean_power_w).collect();
        Ok(Self {
            case,
            settled: results
                .iter()
                .map(|result| {
                    result
                        .settlement
                        .is_some_and(|settlement| settlement.settled)
                })
                .collect(),
            linear_best: optimal_resistance(&harvester.plant(case)?, 0)?,
            impact_best_ohm: best_ohm(&resistance_ohm, &impact_w),
            linear_line: (line_ohm, line_w),
            resistance_ohm,
            impact_w,
            linear_w,
        })
    }

    /// Returns the smallest and largest ratio of the powers with and without impact, over all
    /// resistances.
    pub fn gain_range(&self) -> (f64, f64) {
        let charge_balance = self
            .impact_w
            .iter()
            .zip(&self.linear_w)
            .map(|(impact, linear)| impact / linear);
        charge_balance.fold((f64::INFINITY, 0.0), |(low, high), gain| {
            (low.min(gain), high.max(gain))
        })
    }

    /// Returns the figure with its number in the paper.
    pub fn figure(&self, number: u32, stop: &NamedStop) -> NamedFigure {
        let line =
            |label: &str, direction, ohm: &[f64], value: &[f64], settled: &[bool]| SweepLine {
                label: label.to_owned(),
                direction,
                parameter: ohm.to_vec(),
                value: value.to_vec(),
                settled: settled.to_vec(),
            };
        let lines = [
            line(
                "without impact",
                LineDirection::Linear,
                &self.linear_line.0,
                &self.linear_line.1,
                &[],
            ),
            line(
                "with impact",
                LineDirection::Independent,
                &self.resistance_ohm,
                &self.impact_w,
                &self.settled,
            ),
        ];
        let title = format!(
            "Mean power at {} Hz and {} N",
            self.case.frequency_hz, self.case.amplitude_n
        );
        let caption = format!(
            "Figure {number}. Mean power over the load resistance at {} Hz and {} N; each point with impact is a run of 20 s from rest, the \
             last 10 s averaged. Dotted lines mark the best loads.{}",
            self.case.frequency_hz, self.case.amplitude_n, stop.words
        );
        NamedFigure::new(
            &format!("figure-{number}{}", stop.suffix),
            &caption,
            power_against_resistance(&title, "W", &lines),
        )
    }

    /// Returns the data of the figure.
    pub fn table(&self, number: u32, stop: &NamedStop) -> Result<NamedTable, ReproduceError> {
        let table = Table::new(vec![
            Column::new(
                "resistance_ohm",
                "ohm",
                "Load resistance",
                self.resistance_ohm.clone(),
            ),
            Column::new(
                "impact_power_w",
                "W",
                "Mean power with impact",
                self.impact_w.clone(),
            ),
            Column::new(
                "linear_power_w",
                "W",
                "Mean power without impact",
                self.linear_w.clone(),
            ),
            Column::new("settled", "", "Settled", self.settled.clone()),
        ])?;
        let caption = format!(
            "Figure {number}: mean power over the load resistance.{}",
            stop.words
        );
        Ok(NamedTable::new(
            &format!("figure-{number}{}", stop.suffix),
            &caption,
            5,
            table,
        ))
    }
}

fn resistances_ohm(per_decade: u32) -> Vec<f64> {
    (0..=3 * per_decade)
        .map(|i| 10f64.powf(4.0 + f64::from(i) / f64::from(per_decade)))
        .collect()
}

/// Returns the maximum of the parabola over `ln R` through the highest of equally spaced (in
/// `ln R`) points and its neighbours; an end point is returned unchanged.
fn best_ohm(resistance_ohm: &[f64], power_w: &[f64]) -> f64 {
    let highest = (0..power_w.len())
        .max_by(|&a, &b| power_w[a].total_cmp(&power_w[b]))
        .unwrap_or(0);
    if highest == 0 || highest + 1 == power_w.len() {
        return resistance_ohm[highest];
    }
    let [before, top, right] = [power_w[highest - 1], power_w[highest], power_w[highest + 1]];
    let shift = 0.5 * (before - right) / (before - 2.0 * top + right);
    let step = (resistance_ohm[highest + 1] / resistance_ohm[highest]).ln();
    resistance_ohm[highest] * (shift * step).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `P = 2 R R_0 / (R^2 + R_0^2)` has its maximum at `R_0`; the largest measured error is 2e-3.
    #[test]
    fn the_best_resistance_lies_between_the_points() {
        let ohm: Vec<f64> = (0..=30)
            .map(|i| 10f64.powf(4.0 + f64::from(i) / 10.0))
            .collect();
        for best in [60e3, 67e3, 69.2e3, 75e3] {
            let power: Vec<f64> = ohm
                .iter()
                .map(|r| 2.0 * r * best / (r * r + best * best))
                .collect();
            assert!((best_ohm(&ohm, &power) / best - 1.0).abs() < 3e-3);
        }
        assert_eq!(best_ohm(&[1.0, 2.0, 4.0], &[3.0, 2.0, 1.0]), 1.0);
    }
}
