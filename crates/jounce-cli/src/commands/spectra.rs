//! `jounce spectra FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, any_channel, first_live, load_channels, parse_positive};
use crate::output::{self, line, print};
use clap::{Args, ValueEnum};
use jounce_core::signal::{OrderLine, Samples, Window};
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::draw::{densities_of, spectrogram_of};
use jounce_measure::recording::{Channel, Quantity};
use jounce_measure::spectral::{
    Spectra as MeasuredSpectra, SpectraSettings, density_unit, signal, spectra, spectrogram,
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
    spectra: MeasuredSpectra,
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
            .map(|text| parse_positive("--drive", text, Unit::Frequency))
            .transpose()?;
        let segment_s = self
            .segment
            .as_ref()
            .map(|text| parse_positive("--segment", text, Unit::Time))
            .transpose()?;
        let summary = self.file.summary()?;
        let number = match &self.channel {
            Some(name) => any_channel(&summary, name)?,
            None => first_live(&summary, Quantity::Voltage)
                .ok_or_else(|| Failure::Input(format!("{} has no channel", summary.name)))?,
        };
        let record = load_channels(summary, &[number])?;
        let channel = &record.channels[0];
        let samples = signal(channel, record.rate())?;
        let window = match self.window {
            WindowName::Hann => Window::Hann,
            WindowName::FlatTop => Window::FlatTop,
            WindowName::Rectangular => Window::Rectangular,
        };
        let spectra = spectra(
            &samples,
            &SpectraSettings {
                drive_hz,
                segment_s,
                overlap: self.overlap,
                window,
            },
        )?;
        let result = SpectraResult {
            channel,
            samples,
            spectra,
        };
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &result, drive_hz)?;
        }
        if self.file.output.json {
            print(&self.to_json(&result, &record.findings));
        } else {
            self.print_result(&result);
        }
        Ok(())
    }

    /// Describes window, overlap and amplitude.
    fn convention(&self, result: &SpectraResult<'_>) -> String {
        let MeasuredSpectra {
            density, segments, ..
        } = &result.spectra;
        let window = format!("{:?}", self.window)
            .to_lowercase()
            .replace("flattop", "flat-top");
        format!(
            "{} segments of {:.4} s, {} window, overlap {}: lines {:.4} Hz apart; amplitudes are zero to peak, densities one-sided, per Hz",
            density.segments,
            result.seconds(segments.length()),
            window,
            self.overlap,
            density.resolution_hz
        )
    }

    fn print_result(&self, result: &SpectraResult<'_>) {
        let (unit, squared) = (&result.channel.unit, density_unit(&result.channel.unit));
        line(format!(
            "{}: {}",
            result.channel.name,
            self.convention(result)
        ));
        line(format!(
            "mean {:.5e} {unit}, subtracted before the density",
            result.spectra.density.mean
        ));
        for peak in result.spectra.peaks(REPORTED_PEAKS) {
            line(format!(
                "peak at {:>10.4} Hz: {:.4e} {squared}",
                peak.frequency_hz, peak.density
            ));
        }
        for order in &result.spectra.orders {
            line(format!(
                "order {:>6.4}, {:>10.4} Hz: {:.5e} {unit} peak",
                order.order, order.frequency_hz, order.amplitude_peak
            ));
        }
    }

    fn to_json(
        &self,
        result: &SpectraResult<'_>,
        findings: &[jounce_measure::recording::Issue],
    ) -> serde_json::Value {
        let order = |order: &OrderLine| serde_json::json!({ "order": order.order, "frequency_hz": order.frequency_hz, "amplitude_peak": order.amplitude_peak });
        let MeasuredSpectra {
            density, segments, ..
        } = &result.spectra;
        serde_json::json!({
            "channel": result.channel.name,
            "unit": result.channel.unit,
            "convention": self.convention(result),
            "segment_s": result.seconds(segments.length()),
            "step_s": result.seconds(segments.step()),
            "segments": density.segments,
            "resolution_hz": density.resolution_hz,
            "mean": density.mean,
            "peaks": result.spectra.peaks(REPORTED_PEAKS),
            "frequency_hz": density.frequency_hz,
            "density": density.density,
            "orders": result.spectra.orders.iter().map(order).collect::<Vec<_>>(),
            "findings": findings,
        })
    }

    fn write(
        &self,
        folder: &Path,
        result: &SpectraResult<'_>,
        drive_hz: Option<f64>,
    ) -> Result<(), Failure> {
        let (channel, density) = (result.channel, &result.spectra.density);
        let spectrogram = spectrogram(&result.samples, &result.spectra.segments)?;
        let manifest = self
            .file
            .manifest("spectra")?
            .with("convention", self.convention(result))
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
            spectrogram
                .time_s
                .iter()
                .flat_map(|t| spectrogram.frequency_hz.iter().map(move |f| (*t, *f)))
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
                spectrogram.amplitude_peak.concat(),
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
                &self.convention(result),
                &channel.name,
                &channel.unit,
                &spectrogram,
                drive_hz,
            ),
        )
    }
}
