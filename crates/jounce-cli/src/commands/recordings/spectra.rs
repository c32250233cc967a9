//! `jounce spectra FILE`

use crate::failure::Failure;
use crate::measured_file::{MeasuredFile, or_issues, print_issues};
use crate::output::{self, line};
use clap::Args;
use jounce::{SpectraOptions, SpectraResult};
use std::path::Path;

/// Arguments of `spectra`.
#[derive(Debug, Args)]
pub struct Spectra {
    #[command(flatten)]
    pub file: MeasuredFile,
    #[command(flatten)]
    options: SpectraOptions,
}

impl Spectra {
    /// Transforms and reports.
    pub fn run(&self) -> Result<(), Failure> {
        let options = SpectraOptions {
            spectrogram: self.file.output.out.is_some(),
            ..self.options.clone()
        };
        let recording = self.file.recording(&options)?;
        let result = or_issues(recording.spectra(&options), &[recording])?;
        print_issues(&result.issues);
        if let Some(folder) = &self.file.output.out {
            self.write(folder, &result)?;
        }
        match self.file.output.json {
            true => line(output::to_json(&result)?),
            false => print_lines(&result),
        }
        Ok(())
    }

    fn write(&self, folder: &Path, result: &SpectraResult) -> Result<(), Failure> {
        let manifest = self
            .file
            .manifest("spectra", &self.options)?
            .with("convention", &result.convention)
            .with("channel", &result.channel);
        output::table(folder, "spectra", &result.table()?, &manifest)?;
        output::figure(folder, "spectra", &result.figure())?;
        if let Some(table) = result.spectrogram_table()? {
            output::table(folder, "spectrogram", &table, &manifest)?;
        }
        if let Some(figure) = result.spectrogram_figure() {
            output::figure(folder, "spectrogram", &figure)?;
        }
        Ok(())
    }
}

/// Prints the result as lines of text.
fn print_lines(result: &SpectraResult) {
    let (unit, squared) = (&result.unit, result.density_unit());
    line(format!("{}: {}", result.channel, result.convention));
    line(format!(
        "mean {:.5e} {unit}, subtracted before the density",
        result.mean
    ));
    for peak in &result.peaks {
        line(format!(
            "peak at {:>10.4} Hz: {:.4e} {squared}",
            peak.frequency_hz, peak.density
        ));
    }
    for order in &result.orders {
        line(format!(
            "order {:>6.4}, {:>10.4} Hz: {:.5e} {unit} peak",
            order.order, order.frequency_hz, order.amplitude_peak
        ));
    }
}
