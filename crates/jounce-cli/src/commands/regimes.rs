//! `jounce regimes FILE --drive F`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, channel, positive, tell_findings};
use crate::output::{line, print};
use clap::Args;
use jounce::signal::Samples;
use jounce::spec::Quantity as Unit;
use jounce_measure::recording::Quantity;
use jounce_measure::regime::{Stretch, regimes};
use jounce_measure::spectral::{MeanPower, mean_power};

/// Arguments of `regimes`.
#[derive(Debug, Args)]
pub struct RegimesOf {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Frequency of the drive, as in 13Hz.
    #[arg(long)]
    drive: String,
    /// Channel to cut; by default the first one in volts.
    #[arg(long, value_name = "CHANNEL")]
    channel: Option<String>,
    /// Resistance of the load, where the channel is its voltage: power is told for each stretch.
    #[arg(long)]
    resistance: Option<String>,
}

impl RegimesOf {
    /// Cuts and tells.
    pub fn run(&self) -> Result<(), Failure> {
        let drive_hz = positive("--drive", &self.drive, Unit::Frequency)?;
        let resistance = self.resistance.as_ref().map(|text| positive("--resistance", text, Unit::Resistance)).transpose()?;
        let record = self.file.record()?;
        tell_findings(&record);
        let channel = channel(&record, self.channel.as_deref(), Quantity::Voltage, "--channel")?;
        let found = regimes(&Samples::new(&channel.values, record.rate())?, drive_hz)?;
        let power = |stretch: &Stretch| -> Result<Option<MeanPower>, Failure> {
            let Some(ohm) = resistance else { return Ok(None) };
            let part = Samples::new(&channel.values[stretch.start..stretch.end], record.rate())?;
            Ok(Some(mean_power(&part, ohm, false)?))
        };
        let powers = found.stretches.iter().map(power).collect::<Result<Vec<_>, _>>()?;
        if self.file.json {
            print(&serde_json::json!({ "channel": channel.name, "regimes": found, "powers": powers, "findings": record.findings }));
            return Ok(());
        }
        line(format!("{} stretches; a change lies within {:.3} s of its place", found.stretches.len(), found.uncertainty_s));
        for (stretch, power) in found.stretches.iter().zip(powers) {
            let period = stretch.period.cycles.map_or("does not repeat".to_owned(), |cycles| format!("period {cycles} cycles"));
            let told = power.map_or(String::new(), |power| format!(", {:.5e} +- {:.1e} W", power.mean_power_w, power.half_width_w));
            let (start, end, rms) = (stretch.start_s, stretch.end_s, stretch.rms);
            line(format!(
                "{start:>10.3} s to {end:>10.3} s  rms {rms:.5e} {}, {period} (mismatch {:.3}){told}",
                channel.unit, stretch.period.mismatch
            ));
        }
        Ok(())
    }
}
