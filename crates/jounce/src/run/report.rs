//! Table and figures of the stored end of a run.

use super::{History, RunResult};
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{Figure, Scale, SpectrumLine, Trace, spectra, time_histories};
use jounce_signal::{Samples, Window};

/// Largest number of samples in the figure of the time histories.
const MAX_DRAWN_SAMPLES: usize = 4096;
/// Highest drawn multiple of the drive frequency.
const DRAWN_HARMONICS: f64 = 12.0;
/// Share of the sampling rate that is drawn without a drive.
const DRAWN_SHARE: f64 = 0.5;

impl RunResult {
    /// Returns the table of the stored end: time, voltages of patches and storages, displacements towards the stops, contact
    /// forces; `None` without a record.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Option<Table>, Error> {
        let Some(history) = &self.history else {
            return Ok(None);
        };
        let time = Column::new("time_s", "s", "time", history.even.time_s.clone());
        let mut table = Table::new(vec![time])?;
        for trace in history.traces() {
            let name = trace.quantity.to_lowercase().replace(' ', "_");
            table.push(Column::new(
                &name,
                &trace.unit,
                &trace.quantity,
                trace.values,
            ))?;
        }
        Ok(Some(table))
    }

    /// Returns the figures of the stored end with their names: time histories and the spectrum of
    /// the first voltage; none without a record.
    ///
    /// # Errors
    /// [`Error::Signal`] for a record that is too short for a spectrum.
    pub fn figures(&self) -> Result<Vec<(&'static str, Figure)>, Error> {
        let Some(history) = &self.history else {
            return Ok(Vec::new());
        };
        let time_s = &history.even.time_s;
        let first = time_s.len().saturating_sub(MAX_DRAWN_SAMPLES);
        let traces = history.traces();
        let last = |trace: &Trace| Trace {
            values: trace.values[first..].to_vec(),
            ..trace.clone()
        };
        let last: Vec<Trace> = traces.iter().map(last).collect();
        let mut figures = vec![(
            "run-time",
            time_histories("End of the run", &time_s[first..], &last),
        )];
        if let Some(voltage) = traces.first() {
            figures.push(("run-spectrum", spectrum(voltage, history)?));
        }
        Ok(figures)
    }
}

fn spectrum(voltage: &Trace, history: &History) -> Result<Figure, Error> {
    let (rate_hz, drive_hz) = (history.sample_rate_hz, history.drive_frequency_hz);
    // A record of whole periods ends at the phase of its first sample.
    let samples = &voltage.values[..voltage.values.len().saturating_sub(1)];
    let spectrum = Samples::new(samples, rate_hz)?.spectrum(Window::Hann);
    let highest_hz = drive_hz.map_or(DRAWN_SHARE * rate_hz, |drive_hz| DRAWN_HARMONICS * drive_hz);
    let count = spectrum
        .frequency_hz
        .iter()
        .take_while(|hz| **hz <= highest_hz)
        .count();
    let line = SpectrumLine {
        label: voltage.quantity.clone(),
        frequency_hz: spectrum.frequency_hz[..count].to_vec(),
        amplitude_peak: spectrum.amplitude_peak[..count].to_vec(),
    };
    let title = "Voltage spectrum, Hann window";
    Ok(spectra(
        title,
        &voltage.quantity,
        "V",
        Scale::Log,
        &[line],
        drive_hz,
    ))
}

impl History {
    /// Returns the traces of table and figure.
    fn traces(&self) -> Vec<Trace> {
        let even = &self.even;
        let rows =
            |quantity: &str, unit: &str, names: &[String], rows: &[Vec<f64>]| -> Vec<Trace> {
                let trace = |(name, values): (&String, &Vec<f64>)| Trace {
                    quantity: format!("{quantity} {name}"),
                    unit: unit.to_owned(),
                    values: values.clone(),
                };
                names.iter().zip(rows).map(trace).collect()
            };
        let mut traces = rows("Voltage of", "V", &self.patch, &even.voltage_v);
        traces.extend(rows(
            "Storage voltage of",
            "V",
            &self.storage,
            &even.storage_voltage_v,
        ));
        traces.extend(rows(
            "Towards",
            "m",
            &self.stop,
            &even.relative_displacement_m,
        ));
        let mut forces = rows("Contact force of", "N", &self.stop, &even.force_n);
        if let [only] = &mut forces[..] {
            only.quantity = "Contact force".to_owned();
        }
        traces.extend(forces);
        traces
    }
}
