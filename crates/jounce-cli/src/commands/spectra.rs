//! `jounce spectra FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, any_channel, first_live, loaded, positive};
use crate::output::{self, line, print};
use clap::{Args, ValueEnum};
use jounce_core::signal::{OrderLine, Samples, Window};
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::draw::{densities_of, spectrogram_of};
use jounce_measure::recording::{Channel, Quantity};
use jounce_measure::spectral::{
    Spectra as Found, SpectraSettings, density_unit, signal, spectra, spectrogram,
};
use std::path::Path;

/// Number of reported peaks, the highest first.
const REPORTED_PEAKS: usize = 5;

/// Weights of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum WindowName {
    /// Finest frequency resolution: a line is four bins wide; a sinusoid between two bins shows up
    /// to 15 % less.
    Hann,
    /// Accurate amplitudes: a line is ten bins wide; a sinusoid between two bins shows at most 0.1
    /// % less.
    FlatTop,
    /// No weights, for complete periods only.
    Rectangular,
}

/// Arguments of `spectra`.
#[derive(Debug, Args)]
pub struct Spectra {
    #[command(flatten)]
    pub file: MeasuredFile,
    /// Channel to transform; by default the first varying one in volts, else the first varying one.
    #[arg(long, value_name = "CHANNEL")]
    channel: Option<String>,
    /// Frequency of the drive, as in 13Hz: amplitudes at its multiples are reported and marked.
    #[arg(long)]
    drive: Option<String>,
    /// Length of a segment, as in 2s; by default 24 cycles of the drive, or without a drive a
    /// thirty-second of the record.
    #[arg(long, value_name = "TIME")]
    segment: Option<String>,
    /// Overlap of adjacent segments, as a share of a segment.
    #[arg(long, default_value_t = 0.5)]
    overlap: f64,
    /// Weights of a segment.
    #[arg(long, value_enum, default_value = "hann")]
    window: WindowName,
}

/// Result of the transform of a record.
struct SpectraResult<'a> {
    channel: &'a Channel,
    samples: Samples<'a>,
    found: Found,
}

impl SpectraResult<'_> {
    /// Converts a number of samples to s.
    fn seconds(&self, samples: usize) -> f64 {
        samples as f64 / self.samples.rate_hz()
    }
}

impl Spectra {
    /// Transforms and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let drive_hz = self
            .drive
            .as_ref()
            .map(|text| positive("--drive", text, Unit::Frequency))
            .transpose()?;
        let segment_s = self
            .segment
            .as_ref()
            .map(|text| positive("--segment", text, Unit::Time))
            .transpose()?;
        let survey = self.file.survey()?;
        let number = match &self.channel {
            Some(name) => any_channel(&survey, name)?,
            None => first_live(&survey, Quantity::Voltage)
                .ok_or_else(|| Failure::Input(format!("{} has no channel", survey.name)))?,
        };
        let record = loaded(survey, &[number])?;
        let channel = &record.channels[0];
        let samples = signal(channel, record.rate())?;
        let window = match self.window {
            WindowName::Hann => Window::Hann,
            WindowName::FlatTop => Window::FlatTop,
            WindowName::Rectangular => Window::Rectangular,
        };
        let found = spectra(
            &samples,
            &SpectraSettings {
                drive_hz,
                segment_s,
                overlap: self.overlap,
                window,
            },
        )?;
        let answer = SpectraResult {
            channel,
            samples,
            found,
        };
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &answer, drive_hz)?;
        }
        if self.file.output.json {
            print(&self.listed(&answer, &record.findings));
        } else {
            self.tell(&answer);
        }
        Ok(())
    }

    /// Describes window, overlap and amplitude.
    fn convention(&self, answer: &SpectraResult<'_>) -> String {
        let Found {
            density, segments, ..
        } = &answer.found;
        let window = format!("{:?}", self.window)
            .to_lowercase()
            .replace("flattop", "flat-top");
        format!(
            "{} segments of {:.4} s, {} window, overlap {}: lines {:.4} Hz apart; amplitudes are zero to peak, densities one-sided, per Hz",
            density.segments,
            answer.seconds(segments.length()),
            window,
            self.overlap,
            density.resolution_hz
        )
    }

    fn tell(&self, answer: &SpectraResult<'_>) {
        let (unit, squared) = (&answer.channel.unit, density_unit(&answer.channel.unit));
        line(format!(
            "{}: {}",
            answer.channel.name,
            self.convention(answer)
        ));
        line(format!(
            "mean {:.5e} {unit}, subtracted before the density",
            answer.found.density.mean
        ));
        for peak in answer.found.peaks(REPORTED_PEAKS) {
            line(format!(
                "peak at {:>10.4} Hz: {:.4e} {squared}",
                peak.frequency_hz, peak.density
            ));
        }
        for order in &answer.found.orders {
            line(format!(
                "order {:>6.4}, {:>10.4} Hz: {:.5e} {unit} peak",
                order.order, order.frequency_hz, order.amplitude_peak
            ));
        }
    }

    fn listed(
        &self,
        answer: &SpectraResult<'_>,
        findings: &[jounce_measure::recording::Issue],
    ) -> serde_json::Value {
        let order = |order: &OrderLine| serde_json::json!({ "order": order.order, "frequency_hz": order.frequency_hz, "amplitude_peak": order.amplitude_peak });
        let Found {
            density, segments, ..
        } = &answer.found;
        serde_json::json!({
            "channel": answer.channel.name,
            "unit": answer.channel.unit,
            "convention": self.convention(answer),
            "segment_s": answer.seconds(segments.length()),
            "step_s": answer.seconds(segments.step()),
            "segments": density.segments,
            "resolution_hz": density.resolution_hz,
            "mean": density.mean,
            "peaks": answer.found.peaks(REPORTED_PEAKS),
            "frequency_hz": density.frequency_hz,
            "density": density.density,
            "orders": answer.found.orders.iter().map(order).collect::<Vec<_>>(),
            "findings": findings,
        })
    }

    fn write(
        &self,
        folder: &Path,
        answer: &SpectraResult<'_>,
        drive_hz: Option<f64>,
    ) -> Result<(), Failure> {
        let (channel, density) = (answer.channel, &answer.found.density);
        let found = spectrogram(&answer.samples, &answer.found.segments)?;
        let manifest = self
            .file
            .manifest("spectra")?
            .with("convention", self.convention(answer))
            .with("channel", channel.name.clone());
        let squared = density_unit(&channel.unit);
        let table = Table::new(vec![
            Column::new(
                "frequency_hz",
                "Hz",
                "frequency of the line",
                density.frequency_hz.clone(),
            ),
            Column::new(
                "density",
                &squared,
                "one-sided power spectral density (Welch)",
                density.density.clone(),
            ),
        ])?;
        output::table(folder, "spectra", &table, &manifest)?;
        let cells = || {
            found
                .time_s
                .iter()
                .flat_map(|t| found.frequency_hz.iter().map(move |f| (*t, *f)))
        };
        let table = Table::new(vec![
            Column::new(
                "time_s",
                "s",
                "middle of the segment, from the first sample",
                cells().map(|cell| cell.0).collect::<Vec<_>>(),
            ),
            Column::new(
                "frequency_hz",
                "Hz",
                "frequency of the line",
                cells().map(|cell| cell.1).collect::<Vec<_>>(),
            ),
            Column::new(
                "amplitude_peak",
                &channel.unit,
                "peak amplitude",
                found.amplitude_peak.concat(),
            ),
        ])?;
        output::table(folder, "spectrogram", &table, &manifest)?;
        output::figure(
            folder,
            "spectra",
            &densities_of(
                "Power spectral density",
                &channel.name,
                &channel.unit,
                density,
            ),
        )?;
        output::figure(
            folder,
            "spectrogram",
            &spectrogram_of(
                &self.convention(answer),
                &channel.name,
                &channel.unit,
                &found,
                drive_hz,
            ),
        )
    }
}
