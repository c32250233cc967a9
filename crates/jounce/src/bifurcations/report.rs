//! Table, figure and warnings of bifurcation curves.

use super::{BifurcationCurve, BifurcationsResult};
use crate::error::Error;
use jounce_analysis::BifurcationCurvePoint;
use jounce_io::table::{Column, Table};
use jounce_plot as picture;
use jounce_plot::{Axis, BifurcationLine, Figure};

impl BifurcationsResult {
    /// Returns the table of every point of every curve.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let rows: Vec<(u64, &BifurcationCurve, &BifurcationCurvePoint)> = (0..)
            .zip(&self.curves)
            .flat_map(|(k, curve)| curve.points.iter().map(move |point| (k, curve, point)))
            .collect();
        let number =
            |name: &str, unit: &str, about: &str, value: fn(&BifurcationCurvePoint) -> f64| {
                let values: Vec<f64> = rows.iter().map(|(.., point)| value(point)).collect();
                Column::new(name, unit, about, values)
            };
        let number_of_curve: Vec<u64> = rows.iter().map(|(k, ..)| *k).collect();
        let name = rows.iter().map(|(_, curve, _)| curve.name().to_owned());
        let name: Vec<String> = name.collect();
        let period = rows.iter().map(|(_, curve, _)| curve.period_cycles.into());
        let period: Vec<u64> = period.collect();
        Ok(Table::new(vec![
            Column::new("curve", "", "number of the curve, from 0", number_of_curve),
            Column::new("kind", "", "kind of the bifurcation, or the level", name),
            Column::new("period_cycles", "", "period in drive cycles", period),
            number("parameter", &self.unit, &self.key, |point| point.parameter),
            number("parameter_2", &self.unit_2, &self.key_2, |point| {
                point.parameter_2
            }),
            number("mean_power_w", "W", "mean power of all loads", |point| {
                point.mean_power_w
            }),
        ])?)
    }

    /// Returns the figure of the curves in the plane of the two keys.
    pub fn figure(&self) -> Figure {
        let line = |curve: &BifurcationCurve| BifurcationLine {
            kind: curve.name().to_owned(),
            x: curve.points.iter().map(|point| point.parameter).collect(),
            y: curve.points.iter().map(|point| point.parameter_2).collect(),
        };
        let lines: Vec<BifurcationLine> = self.curves.iter().map(line).collect();
        picture::bifurcations(
            "Bifurcation curves",
            Axis::linear(&self.key, &self.unit),
            Axis::linear(&self.key_2, &self.unit_2),
            &lines,
        )
    }

    /// Returns the warnings about curves that end early.
    pub fn warnings(&self) -> Vec<String> {
        let of_curve = |curve: &BifurcationCurve| {
            let text = |reason: &String| {
                format!(
                    "a curve of kind {} ends early in {}: {reason}",
                    curve.name(),
                    self.key_2
                )
            };
            curve.failures.iter().map(text).collect::<Vec<_>>()
        };
        self.curves.iter().flat_map(of_curve).collect()
    }
}
