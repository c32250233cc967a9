//! Tables and figures of spectra.

use super::SpectraResult;
use crate::error::Error;
use jounce_experiment::draw::{densities_of, spectrogram_of};
use jounce_io::table::{Column, Table};
use jounce_plot::Figure;
use jounce_signal::spectral::{Density, density_unit};

impl SpectraResult {
    /// Returns the unit of the density.
    pub fn density_unit(&self) -> String {
        density_unit(&self.unit)
    }

    /// Returns the table of the density.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        Ok(Table::new(vec![
            Column::new(
                "frequency_hz",
                "Hz",
                "frequency of the line",
                self.frequency_hz.clone(),
            ),
            Column::new(
                "density",
                &self.density_unit(),
                "one-sided power spectral density (Welch)",
                self.density.clone(),
            ),
        ])?)
    }

    /// Returns the table of the spectrogram, a row for each segment and line; `None` unless it was
    /// requested.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn spectrogram_table(&self) -> Result<Option<Table>, Error> {
        let Some(spectrogram) = &self.spectrogram else {
            return Ok(None);
        };
        let lines = spectrogram.frequency_hz.len();
        let time_s = spectrogram.time_s.iter();
        let time_s: Vec<f64> = time_s.flat_map(|t| vec![*t; lines]).collect();
        let frequency_hz = spectrogram.frequency_hz.repeat(spectrogram.time_s.len());
        Ok(Some(Table::new(vec![
            Column::new(
                "time_s",
                "s",
                "middle of the segment, from the first sample",
                time_s,
            ),
            Column::new("frequency_hz", "Hz", "frequency of the line", frequency_hz),
            Column::new(
                "amplitude_peak",
                &self.unit,
                "peak amplitude",
                spectrogram.amplitude_peak.concat(),
            ),
        ])?))
    }

    /// Returns the figure of the density.
    pub fn figure(&self) -> Figure {
        let density = Density {
            frequency_hz: self.frequency_hz.clone(),
            density: self.density.clone(),
            segments: self.segments,
            resolution_hz: self.resolution_hz,
            mean: self.mean,
        };
        let title = format!("Power spectral density of {}", self.channel);
        densities_of(&title, &self.channel, &self.unit, &density)
    }

    /// Returns the figure of the spectrogram; `None` unless it was requested.
    pub fn spectrogram_figure(&self) -> Option<Figure> {
        let spectrogram = self.spectrogram.as_ref()?;
        let channel = &self.channel;
        let title = format!("Spectrogram of {channel}: {}", self.convention);
        let figure = spectrogram_of(&title, channel, &self.unit, spectrogram, self.drive_hz);
        Some(figure)
    }
}
