//! `jounce regimes FILE --drive F`

use super::segment_model::{self, ModelArguments};
use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, any_channel, channel, load_channels, parse_positive};
use crate::output::{self, line, print, with_uncertainty};
use clap::Args;
use jounce_core::signal::Samples;
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::draw::{segment_section, segment_spectra, segments};
use jounce_measure::recording::{Channel, Quantity};
use jounce_measure::segmentation::{
    MAX_PERIOD_CYCLES, MergeReason, RecordSegment, SegmentMatches, Segmentation, regimes,
};
use jounce_measure::spectral::{MeanPower, mean_power_if_long};
use std::path::Path;

/// Arguments of `regimes`.
#[derive(Debug, Args)]
pub struct Segments {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Frequency of the drive, as in 13Hz. Periods of up to 12 of its cycles are found.
    #[arg(long)]
    drive: String,
    /// Channel to segment; by default the first one in volts.
    #[arg(long, value_name = "CHANNEL")]
    channel: Option<String>,
    /// Resistance of the load, where the channel is its voltage: the power of each segment is
    /// reported.
    #[arg(long)]
    resistance: Option<String>,
    #[command(flatten)]
    model: ModelArguments,
}

impl Segments {
    /// Segments and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let drive_hz = parse_positive("--drive", &self.drive, Unit::Frequency)?;
        let resistance = self
            .resistance
            .as_ref()
            .map(|text| parse_positive("--resistance", text, Unit::Resistance))
            .transpose()?;
        let mut summary = self.file.summary()?;
        let number = match &self.channel {
            // Any quantity can be segmented; only a voltage has a power.
            Some(name) if resistance.is_none() => any_channel(&summary, name)?,
            name => channel(
                &mut summary,
                name.as_deref(),
                Quantity::Voltage,
                "--channel",
            )?,
        };
        let record = load_channels(summary, &[number])?;
        let channel = &record.channels[0];
        let segmentation = regimes(&Samples::new(&channel.values, record.rate())?, drive_hz)?;
        let power = |segment: &RecordSegment| -> Result<Option<MeanPower>, Failure> {
            let Some(ohm) = resistance else {
                return Ok(None);
            };
            let samples_of_segment =
                Samples::new(&channel.values[segment.start..segment.end], record.rate())?;
            Ok(mean_power_if_long(&samples_of_segment, ohm, false)?)
        };
        let powers = segmentation
            .stretches
            .iter()
            .map(power)
            .collect::<Result<Vec<_>, _>>()?;
        let samples = Samples::new(&channel.values, record.rate())?;
        let matches =
            self.model
                .correspondences(&samples, drive_hz, resistance, &segmentation.stretches)?;
        if let Some(folder) = &self.file.output.out {
            self.write(
                folder,
                (channel, &samples),
                &segmentation,
                &powers,
                &matches,
                drive_hz,
            )?;
        }
        if self.file.output.json {
            print(&serde_json::json!({
                "channel": channel.name,
                "regimes": segmentation,
                "powers": powers,
                "correspondences": matches,
                "findings": record.findings,
            }));
            return Ok(());
        }
        print_segments(
            &segmentation,
            &channel.unit,
            &self.power_texts(&powers),
            &matches,
        );
        Ok(())
    }

    /// Formats the power of each segment; empty without a resistance.
    fn power_texts(&self, powers: &[Option<MeanPower>]) -> Vec<String> {
        let text = |power: &Option<MeanPower>| match power {
            _ if self.resistance.is_none() => String::new(),
            Some(power) => format!(
                ", {}",
                with_uncertainty(power.mean_power_w, power.half_width_w, "W")
            ),
            None => ", too short for a power with a confidence interval".to_owned(),
        };
        powers.iter().map(text).collect()
    }

    fn write(
        &self,
        folder: &Path,
        (channel, samples): (&Channel, &Samples<'_>),
        segmentation: &Segmentation,
        powers: &[Option<MeanPower>],
        matches: &[SegmentMatches],
        drive_hz: f64,
    ) -> Result<(), Failure> {
        let numbers = |value: &dyn Fn(&RecordSegment) -> f64| {
            segmentation
                .stretches
                .iter()
                .map(value)
                .collect::<Vec<f64>>()
        };
        let cycles: Vec<u64> = segmentation
            .stretches
            .iter()
            .map(|s| s.period.cycles.map_or(0, |cycles| cycles as u64))
            .collect();
        let mut table = Table::new(vec![
            Column::new(
                "start_s",
                "s",
                "begin of the segment",
                numbers(&|s| s.start_s),
            ),
            Column::new("end_s", "s", "end of the segment", numbers(&|s| s.end_s)),
            Column::new(
                "rms",
                &channel.unit,
                "rms about the mean",
                numbers(&|s| s.rms),
            ),
            Column::new(
                "period_cycles",
                "",
                "period in drive cycles; 0 where it is longer than 12 or absent",
                cycles,
            ),
            Column::new(
                "mismatch",
                "",
                "deviation from periodicity, relative to the rms",
                numbers(&|s| s.period.mismatch),
            ),
        ])?;
        if self.resistance.is_some() {
            let numbers = |power: &Option<MeanPower>| {
                power.map_or((f64::NAN, f64::NAN), |power| {
                    (power.mean_power_w, power.half_width_w)
                })
            };
            let (mean, half): (Vec<f64>, Vec<f64>) = powers.iter().map(numbers).unzip();
            table.push(Column::new(
                "mean_power_w",
                "W",
                "mean power; NaN where the segment is too short for an interval",
                mean,
            ))?;
            table.push(Column::new(
                "half_width_w",
                "W",
                "half width of its 95 % interval",
                half,
            ))?;
        }
        segment_model::columns(&mut table, matches)?;
        output::table(
            folder,
            "regimes",
            &table,
            &self.file.manifest("regimes")?.with("drive_hz", drive_hz),
        )?;
        let figure = segments(
            "Segments of one solution each",
            &channel.name,
            &channel.unit,
            samples,
            segmentation,
        );
        output::figure(folder, "regimes-time", &figure)?;
        let figure = segment_section(
            "One value per drive cycle",
            &channel.name,
            &channel.unit,
            samples,
            segmentation,
            drive_hz,
        );
        output::figure(folder, "regimes-section", &figure)?;
        let title = "Spectrum of each segment, Hann window";
        let figure = segment_spectra(
            title,
            &channel.name,
            &channel.unit,
            samples,
            segmentation,
            drive_hz,
        )?;
        output::figure(folder, "regimes-spectra", &figure)
    }
}

/// Prints the segments and the changes that are not changes of solution, one line each.
fn print_segments(
    segmentation: &Segmentation,
    unit: &str,
    powers: &[String],
    matches: &[SegmentMatches],
) {
    let count = segmentation.stretches.len();
    let noun = if count == 1 { "segment" } else { "segments" };
    line(format!(
        "{count} {noun}; uncertainty of a change {:.3} s",
        segmentation.uncertainty_s
    ));
    for joint in &segmentation.joints {
        let reason = match joint.reason {
            MergeReason::NoiseChanged => "change of the noise",
            MergeReason::Drifts => "drift of the amplitude",
            MergeReason::Glitch => "short disturbance",
        };
        line(format!("{:>10.3} s: {reason}, same solution", joint.at_s));
    }
    for (k, (segment, power)) in segmentation.stretches.iter().zip(powers).enumerate() {
        let period = segment.period.cycles.map_or_else(
            || format!("period longer than {MAX_PERIOD_CYCLES} cycles, or not periodic"),
            |cycles| format!("period {cycles} cycles"),
        );
        let (start, end, rms) = (segment.start_s, segment.end_s, segment.rms);
        line(format!(
            "{start:>10.3} s to {end:>10.3} s  rms {rms:.5e} {}, {period} (mismatch {:.3}){power}",
            unit, segment.period.mismatch
        ));
        if let Some(matches) = matches.get(k) {
            segment_model::print_match(matches);
        }
    }
}
