//! Table and figure of a sweep.

use super::{SweepPoint, SweepResult};
use crate::error::Error;
use jounce_analysis::SweepDirection;
use jounce_io::table::{Column, Table, Values};
use jounce_plot as picture;
use jounce_plot::{Axis, Figure, LineDirection, SweepLine, SweepLook};

impl SweepResult {
    /// Returns the table of the points, in order.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let points = &self.points;
        let column = |name: &str, unit: &str, about: &str, values: Values| {
            Column::new(name, unit, about, values)
        };
        let number = |value: fn(&SweepPoint) -> f64| {
            Values::from(points.iter().map(value).collect::<Vec<f64>>())
        };
        let direction = |point: &SweepPoint| point.direction.name().to_owned();
        let direction: Vec<String> = points.iter().map(direction).collect();
        let settled: Vec<bool> = points.iter().map(|point| point.settled).collect();
        let period = |point: &SweepPoint| u64::from(point.period_cycles);
        let period: Vec<u64> = points.iter().map(period).collect();
        Ok(Table::new(vec![
            column(
                "parameter",
                &self.unit,
                &self.key,
                number(|point| point.parameter),
            ),
            column("direction", "", "direction of the sweep", direction.into()),
            column(
                "mean_power_w",
                "W",
                "mean power of all loads",
                number(|point| point.mean_power_w),
            ),
            column(
                "voltage_rms_v",
                "V",
                "rms voltage of the first load, else of the output of the first rectifier",
                number(|point| point.voltage_rms_v),
            ),
            column(
                "max_penetration_m",
                "m",
                "largest penetration of the stop",
                number(|point| point.max_penetration_m),
            ),
            column(
                "contact_rate_hz",
                "1/s",
                "contacts per second",
                number(|point| point.contact_rate_hz),
            ),
            column(
                "settled",
                "",
                "settled at the end of the average",
                settled.into(),
            ),
            column("period_cycles", "", "period in drive cycles", period.into()),
            column(
                "energy_residual_relative",
                "",
                "energy residual of the run",
                number(|point| point.energy_residual_relative),
            ),
        ])?)
    }

    /// Returns the figure of the mean power over the key.
    pub fn figure(&self) -> Figure {
        let directions = [
            (SweepDirection::Up, LineDirection::Up),
            (SweepDirection::Down, LineDirection::Down),
            (SweepDirection::Independent, LineDirection::Independent),
        ];
        let lines: Vec<SweepLine> = directions
            .into_iter()
            .filter_map(|(direction, line)| self.line(direction, line))
            .collect();
        let values: Vec<f64> = self.points.iter().map(|point| point.parameter).collect();
        let style = SweepLook {
            parameter: Axis::for_steps(&self.key, &self.unit, &values),
            value: Axis::log("Mean power", "W"),
        };
        picture::sweep(&format!("Mean power over {}", self.key), &style, &lines)
    }

    /// Returns the points of one direction by ascending value; `None` without any.
    fn line(&self, from: SweepDirection, direction: LineDirection) -> Option<SweepLine> {
        let own = self.points.iter().filter(|point| point.direction == from);
        let mut own: Vec<&SweepPoint> = own.collect();
        own.sort_by(|a, b| a.parameter.total_cmp(&b.parameter));
        (!own.is_empty()).then(|| SweepLine {
            label: "mean power".into(),
            direction,
            parameter: own.iter().map(|point| point.parameter).collect(),
            value: own.iter().map(|point| point.mean_power_w).collect(),
            settled: own.iter().map(|point| point.settled).collect(),
        })
    }
}
