//! Table and figures of the mean power of recorded voltages.

use super::{PowerRecord, PowerResult};
use crate::error::Error;
use jounce_experiment::draw::{LoadPoint, power_over_load};
use jounce_io::table::{Column, Table};
use jounce_plot::{Figure, Scale, SpectrumLine, spectra};

impl PowerResult {
    /// Returns the table of the recordings.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let all = &self.records;
        let number = |name: &str, unit: &str, about: &str, value: fn(&PowerRecord) -> f64| {
            let values: Vec<f64> = all.iter().map(value).collect();
            Column::new(name, unit, about, values)
        };
        let names: Vec<String> = all.iter().map(|record| record.name.clone()).collect();
        let mut table = Table::new(vec![
            Column::new("record", "", "name of the recording", names),
            number(
                "resistance_ohm",
                "ohm",
                "resistance of the load",
                |record| record.resistance_ohm,
            ),
            number("mean_power_w", "W", "mean power", |record| {
                record.power.mean_power_w
            }),
            number(
                "half_width_w",
                "W",
                "half width of its 95 % interval",
                |record| record.power.half_width_w,
            ),
            number("mean_voltage_v", "V", "mean of the voltage", |record| {
                record.power.mean_voltage_v
            }),
        ])?;
        if let Some(squares) = self.mean_squares() {
            table.push(Column::new(
                "mean_square_base_acceleration_m2_s4",
                "m^2/s^4",
                "mean square of the base's acceleration about its mean",
                squares,
            ))?;
        }
        Ok(table)
    }

    /// Returns the figure of the mean power over the load, per mean square of the base acceleration
    /// where that is known.
    pub fn figure(&self) -> Figure {
        let squares = self.mean_squares();
        let unit = match squares {
            Some(_) => "W/(m/s^2)^2",
            None => "W",
        };
        let point = |(k, record): (usize, &PowerRecord)| {
            let divisor = squares.as_ref().map_or(1.0, |squares| squares[k]);
            LoadPoint {
                resistance_ohm: record.resistance_ohm,
                power: record.power.mean_power_w / divisor,
                half_width: record.power.half_width_w / divisor,
            }
        };
        let points: Vec<LoadPoint> = self.records.iter().enumerate().map(point).collect();
        power_over_load("Measured mean power", unit, &points)
    }

    /// Returns the figure of the voltage spectra; empty unless they were requested.
    pub fn spectra_figure(&self) -> Figure {
        let line = |record: &PowerRecord| {
            let spectrum = record.spectrum.clone()?;
            Some(SpectrumLine {
                label: format!("{}: {} ohm", record.name, record.resistance_ohm),
                frequency_hz: spectrum.frequency_hz,
                amplitude_peak: spectrum.amplitude_peak,
            })
        };
        let lines: Vec<SpectrumLine> = self.records.iter().filter_map(line).collect();
        let title = "Voltage spectrum, Hann window";
        spectra(title, "Voltage", "V", Scale::Log, &lines, self.drive_hz)
    }

    /// Returns the mean squares of the base acceleration, if all records have one.
    fn mean_squares(&self) -> Option<Vec<f64>> {
        let square = |record: &PowerRecord| record.mean_square_base_acceleration_m2_s4;
        self.records.iter().map(square).collect()
    }
}
