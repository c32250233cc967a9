//! `jounce power FILE --resistance R`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, channel, positive, tell_findings};
use crate::output::{line, print};
use clap::Args;
use jounce::signal::Samples;
use jounce::spec::Quantity as Unit;
use jounce_measure::recording::Quantity;
use jounce_measure::spectral::mean_power;

/// Arguments of `power`.
#[derive(Debug, Args)]
pub struct Power {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Resistance of the load, as in 100kohm.
    #[arg(long)]
    resistance: String,
    /// Channel of the voltage over the load; by default the first one in volts.
    #[arg(long, value_name = "CHANNEL")]
    voltage: Option<String>,
    /// Channel of the acceleration of the base: power is told per its mean square too.
    #[arg(long, value_name = "CHANNEL")]
    base: Option<String>,
    /// Takes the mean of the voltage away first: that of an amplifier is no power.
    #[arg(long)]
    remove_mean: bool,
}

impl Power {
    /// Computes and tells.
    pub fn run(&self) -> Result<(), Failure> {
        let resistance_ohm = positive("--resistance", &self.resistance, Unit::Resistance)?;
        let record = self.file.record()?;
        tell_findings(&record);
        let voltage = channel(&record, self.voltage.as_deref(), Quantity::Voltage, "--voltage")?;
        let power = mean_power(&Samples::new(&voltage.values, record.rate())?, resistance_ohm, self.remove_mean)?;
        let base = self.base.as_ref().map(|name| record.channel(name)).transpose()?;
        let mean_square = base.map(|base| Samples::new(&base.values, record.rate()).map(|base| base.rms().powi(2) - base.mean().powi(2)));
        let mean_square = mean_square.transpose()?;
        if self.file.json {
            print(&serde_json::json!({
                "channel": voltage.name,
                "power": power,
                "mean_square_base_acceleration_m2_s4": mean_square,
                "mean_power_per_mean_square_base_acceleration": mean_square.map(|square| power.mean_power_w / square),
                "findings": record.findings,
            }));
            return Ok(());
        }
        line(format!("mean power {:.6e} W +- {:.1e} W (95 %, {} batches)", power.mean_power_w, power.half_width_w, power.batches));
        line(format!("mean voltage {:.4e} V, {}", power.mean_voltage_v, if self.remove_mean { "taken away" } else { "kept" }));
        if let Some(square) = mean_square {
            line(format!("per mean square of the base's acceleration: {:.6e} W/(m/s^2)^2", power.mean_power_w / square));
        }
        if power.correlated {
            line("the batches are correlated: the record is too short, and the interval too narrow");
        }
        Ok(())
    }
}
