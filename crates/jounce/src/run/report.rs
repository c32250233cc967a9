//! Table and figures of the stored end of a run.

use super::{History, RunResult};
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{Figure, Scale, SpectrumLine, Trace, spectra, time_histories};
use jounce_signal::{Samples, Window};

/// Largest number of samples in the figure of the time histories.
const MAX_DRAWN_SAMPLES: usize = 4096;
/// Length of the time histories in the figure, s, unless that many samples are longer.
const DRAWN_S: f64 = 1.0;
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
        let count = MAX_DRAWN_SAMPLES.max((DRAWN_S * history.sample_rate_hz) as usize);
        let drawn = DrawnSamples::of(time_s.len().saturating_sub(count), time_s.len());
        let traces = history.traces();
        let last = |trace: &Trace| Trace {
            values: drawn.values(&trace.values),
            ..trace.clone()
        };
        let last: Vec<Trace> = traces.iter().map(last).collect();
        let time_s = drawn.times(time_s);
        let mut figures = vec![(
            "run-time",
            time_histories("Time histories of the run", &time_s, &last),
        )];
        if let Some(voltage) = traces.first() {
            figures.push(("run-spectrum", spectrum(voltage, history)?));
        }
        Ok(figures)
    }
}

/// Samples of a trace that a figure draws: all, or the lowest and the highest of each of many equal
/// bins, so that no peak is lost.
struct DrawnSamples {
    first: usize,
    /// Samples of a bin; 1 where all are drawn.
    bin: usize,
}

impl DrawnSamples {
    /// Draws the samples from `first` to `end`.
    fn of(first: usize, end: usize) -> Self {
        let count = end - first;
        let bin = if count > MAX_DRAWN_SAMPLES {
            (2 * count).div_ceil(MAX_DRAWN_SAMPLES)
        } else {
            1
        };
        Self { first, bin }
    }

    /// Returns the times: of a bin those of its first and its middle sample.
    fn times(&self, time_s: &[f64]) -> Vec<f64> {
        let bins = time_s[self.first..].chunks(self.bin);
        let ends = |bin: &[f64]| [bin[0], bin[bin.len() / 2]];
        match self.bin {
            1 => time_s[self.first..].to_vec(),
            _ => bins.flat_map(ends).collect(),
        }
    }

    /// Returns the values: of a bin the lowest and the highest, in the order of their times.
    fn values(&self, values: &[f64]) -> Vec<f64> {
        let bins = values[self.first..].chunks(self.bin);
        let extremes = |bin: &[f64]| {
            let order = |a: &usize, b: &usize| bin[*a].total_cmp(&bin[*b]);
            let lowest = (0..bin.len()).min_by(order).unwrap_or_default();
            let highest = (0..bin.len()).max_by(order).unwrap_or_default();
            [lowest.min(highest), lowest.max(highest)].map(|index| bin[index])
        };
        match self.bin {
            1 => values[self.first..].to_vec(),
            _ => bins.flat_map(extremes).collect(),
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A peak of one sample among hundred thousand is drawn, and the number of samples is bounded.
    #[test]
    fn drawn_samples_keep_every_peak() {
        let time_s: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut values = vec![0.0; time_s.len()];
        (values[12_345], values[12_346]) = (7.0, -3.0);
        let drawn = DrawnSamples::of(1000, time_s.len());
        let (times, drawn) = (drawn.times(&time_s), drawn.values(&values));
        assert!(times.len() == drawn.len() && drawn.len() <= MAX_DRAWN_SAMPLES);
        assert!(times.is_sorted() && times[0] == 1000.0);
        let high = drawn.iter().position(|value| *value == 7.0);
        assert!(high.is_some_and(|high| (times[high] - 12_345.0).abs() < 100.0));
        assert!(drawn.contains(&-3.0));
        let all = DrawnSamples::of(0, 3);
        assert_eq!(all.values(&[1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    }
}
