//! `jounce power FILE... --resistance R...`

use crate::failure::Failure;
use crate::measured_file::{channel, load_channels, manifest, parse_positive, summary};
use crate::output::{self, line, print, with_uncertainty};
use crate::spec_arguments::OutputArguments;
use clap::Args;
use jounce_core::picture::{Scale, SpectrumLine, spectra};
use jounce_core::signal::{OrderLine, Spectrum, Window};
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::draw::{LoadPoint, power_over_load};
use jounce_measure::recording::{Issue, Quantity};
use jounce_measure::spectral::{MeanPower, mean_power, signal};
use std::path::{Path, PathBuf};

/// Multiples of the drive frequency whose amplitudes are reported.
const REPORTED_ORDERS: [f64; 8] = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];

/// Arguments of `power`.
#[derive(Debug, Args)]
pub struct Power {
    /// The recordings, one for each load: CSV or text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF
    /// or LVM. Channel notes can stand in FILE.channels.toml next to each.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Resistance of the load, as in 100kohm: one for all recordings, or one for each in the same
    /// order.
    #[arg(long, required = true)]
    resistance: Vec<String>,
    /// Channel of the voltage over the load; by default the first one in volts.
    #[arg(long, value_name = "CHANNEL")]
    voltage: Option<String>,
    /// Channel of the base acceleration: power is also reported per mean square of it.
    #[arg(long, value_name = "CHANNEL")]
    base: Option<String>,
    /// Frequency of the drive, as in 13Hz: amplitudes at its multiples are also reported.
    #[arg(long)]
    drive: Option<String>,
    /// Subtracts the mean of the voltage first, where it is an amplifier offset and not power.
    #[arg(long)]
    remove_mean: bool,
    #[command(flatten)]
    pub output: OutputArguments,
}

/// Result of one recording.
struct PowerResult {
    name: String,
    channel: String,
    resistance_ohm: f64,
    power: MeanPower,
    /// Mean square of the base acceleration about its mean, m^2/s^4.
    mean_square: Option<f64>,
    orders: Vec<OrderLine>,
    /// Samples for the picture; they take several times the memory of the voltage.
    spectrum: Option<SpectrumLine>,
    findings: Vec<Issue>,
}

impl Power {
    /// Computes and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let parse = |text: &String| parse_positive("--resistance", text, Unit::Resistance);
        let mut resistances = self
            .resistance
            .iter()
            .map(parse)
            .collect::<Result<Vec<_>, _>>()?;
        if resistances.len() == 1 {
            resistances.resize(self.files.len(), resistances[0]);
        }
        if resistances.len() != self.files.len() {
            let (value_count, files) = (resistances.len(), self.files.len());
            return Err(Failure::usage(format!(
                "{value_count} values of --resistance for {files} recordings: give one for all, or one for each"
            )));
        }
        let drive_hz = self
            .drive
            .as_ref()
            .map(|text| parse_positive("--drive", text, Unit::Frequency))
            .transpose()?;
        let results = self
            .files
            .iter()
            .zip(resistances)
            .map(|(file, ohm)| self.evaluate(file, ohm, drive_hz));
        let results = results.collect::<Result<Vec<_>, _>>()?;
        if let Some(folder) = &self.output.out {
            self.write(folder, &results, drive_hz)?;
        }
        if self.output.json {
            print(
                &serde_json::json!({ "records": results.iter().map(to_json).collect::<Vec<_>>() }),
            );
        } else {
            results.iter().for_each(|result| self.print_result(result));
        }
        Ok(())
    }

    fn evaluate(
        &self,
        file: &Path,
        resistance_ohm: f64,
        drive_hz: Option<f64>,
    ) -> Result<PowerResult, Failure> {
        let mut recording = summary(file)?;
        let voltage = channel(
            &mut recording,
            self.voltage.as_deref(),
            Quantity::Voltage,
            "--voltage",
        )?;
        let base = self
            .base
            .as_ref()
            .map(|name| channel(&mut recording, Some(name), Quantity::Acceleration, "--base"))
            .transpose()?;
        let channels: Vec<usize> = std::iter::once(voltage).chain(base).collect();
        let record = load_channels(recording, &channels)?;
        let voltage = &record.channels[0];
        let samples = signal(voltage, record.rate())?;
        let power = mean_power(&samples, resistance_ohm, self.remove_mean)?;
        let mean_square = match record.channels.get(1) {
            None => None,
            Some(base) => {
                let base = signal(base, record.rate())?;
                Some(base.rms().powi(2) - base.mean().powi(2))
            }
        };
        let orders = match drive_hz {
            None => Vec::new(),
            Some(drive_hz) => {
                let resolved_orders: Vec<f64> = REPORTED_ORDERS
                    .into_iter()
                    .filter(|order| order * drive_hz < 0.5 * record.rate())
                    .collect();
                samples.orders(drive_hz, &resolved_orders)?.lines
            }
        };
        let spectrum = self.output.out.is_some().then(|| {
            let Spectrum {
                frequency_hz,
                amplitude_peak,
                ..
            } = samples.spectrum(Window::Hann);
            SpectrumLine {
                label: format!("{}: {resistance_ohm} ohm", record.name),
                frequency_hz,
                amplitude_peak,
            }
        });
        let (name, channel) = (record.name.clone(), voltage.name.clone());
        Ok(PowerResult {
            name,
            channel,
            resistance_ohm,
            power,
            mean_square,
            orders,
            spectrum,
            findings: record.findings,
        })
    }

    fn print_result(&self, result: &PowerResult) {
        let power = result.power;
        if self.files.len() > 1 {
            line(format!("{}, {} ohm", result.name, result.resistance_ohm));
        }
        let mean = with_uncertainty(power.mean_power_w, power.half_width_w, "W");
        line(format!(
            "mean power {mean} (95 %, {} batches)",
            power.batches
        ));
        line(format!(
            "mean voltage {:.4e} V, {}",
            power.mean_voltage_v,
            if self.remove_mean {
                "subtracted"
            } else {
                "retained"
            }
        ));
        if let Some(square) = result.mean_square {
            line(format!(
                "per mean square of the base's acceleration: {:.6e} W/(m/s^2)^2",
                power.mean_power_w / square
            ));
        }
        for order in &result.orders {
            line(format!(
                "order {:>4}, {:>10.4} Hz: {:.5e} V peak",
                order.order, order.frequency_hz, order.amplitude_peak
            ));
        }
        if power.correlated {
            line(
                "the power is correlated too long for this record, or changes within it (see jounce regimes): the interval is approximate",
            );
        }
    }

    fn write(
        &self,
        folder: &Path,
        results: &[PowerResult],
        drive_hz: Option<f64>,
    ) -> Result<(), Failure> {
        let numbers =
            |value: &dyn Fn(&PowerResult) -> f64| results.iter().map(value).collect::<Vec<f64>>();
        let mut table = Table::new(vec![
            Column::new(
                "recording",
                "",
                "name of the recording",
                results.iter().map(|a| a.name.clone()).collect::<Vec<_>>(),
            ),
            Column::new(
                "resistance_ohm",
                "ohm",
                "resistance of the load",
                numbers(&|a| a.resistance_ohm),
            ),
            Column::new(
                "mean_power_w",
                "W",
                "mean power",
                numbers(&|a| a.power.mean_power_w),
            ),
            Column::new(
                "half_width_w",
                "W",
                "half width of its 95 % interval",
                numbers(&|a| a.power.half_width_w),
            ),
            Column::new(
                "mean_voltage_v",
                "V",
                "mean of the voltage",
                numbers(&|a| a.power.mean_voltage_v),
            ),
        ])?;
        let squares: Option<Vec<f64>> = results.iter().map(|result| result.mean_square).collect();
        if let Some(squares) = &squares {
            let about = "mean square of the base's acceleration about its mean";
            table.push(Column::new(
                "mean_square_base_acceleration_m2_s4",
                "m^2/s^4",
                about,
                squares.clone(),
            ))?;
        }
        let manifest = manifest("power", &self.files)?.with("remove_mean", self.remove_mean);
        output::table(folder, "power", &table, &manifest)?;
        let point = |(k, result): (usize, &PowerResult)| {
            let divisor = squares.as_ref().map_or(1.0, |squares| squares[k]);
            let (power, half_width) = (
                result.power.mean_power_w / divisor,
                result.power.half_width_w / divisor,
            );
            LoadPoint {
                resistance_ohm: result.resistance_ohm,
                power,
                half_width,
            }
        };
        let points: Vec<LoadPoint> = results.iter().enumerate().map(point).collect();
        let unit = if squares.is_some() {
            "W/(m/s^2)^2"
        } else {
            "W"
        };
        output::figure(
            folder,
            "power-load",
            &power_over_load("Measured mean power", unit, &points),
        )?;
        let lines: Vec<SpectrumLine> = results
            .iter()
            .filter_map(|result| result.spectrum.clone())
            .collect();
        let figure = spectra(
            "Voltage spectrum, Hann window",
            "Voltage",
            "V",
            Scale::Log,
            &lines,
            drive_hz,
        );
        output::figure(folder, "power-spectrum", &figure)
    }
}

fn to_json(result: &PowerResult) -> serde_json::Value {
    let order = |order: &OrderLine| serde_json::json!({ "order": order.order, "frequency_hz": order.frequency_hz, "amplitude_peak_v": order.amplitude_peak });
    serde_json::json!({
        "recording": result.name,
        "channel": result.channel,
        "resistance_ohm": result.resistance_ohm,
        "power": result.power,
        "mean_square_base_acceleration_m2_s4": result.mean_square,
        "mean_power_per_mean_square_base_acceleration": result.mean_square.map(|square| result.power.mean_power_w / square),
        "orders": result.orders.iter().map(order).collect::<Vec<_>>(),
        "findings": result.findings,
    })
}
