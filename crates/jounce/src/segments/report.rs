//! Table and figures of segments.

use super::{SegmentResult, SegmentsResult};
use crate::error::Error;
use jounce_experiment::draw::{segment_section, segment_spectra, segments};
use jounce_experiment::segmentation::Candidate;
use jounce_io::table::{Column, Table};
use jounce_plot::Figure;
use jounce_signal::Samples;

impl SegmentsResult {
    /// Returns the table of the segments: with a resistance it has powers, with a model solutions.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let cycles = |segment: &SegmentResult| segment.period_cycles as u64;
        let cycles: Vec<u64> = self.segments.iter().map(cycles).collect();
        let mut table = Table::new(vec![
            self.column("start_s", "s", "begin of the segment", |one| one.start_s),
            self.column("end_s", "s", "end of the segment", |one| one.end_s),
            self.column("rms", &self.unit, "rms about the mean", |one| one.rms),
            Column::new(
                "period_cycles",
                "",
                "period in drive cycles; 0 where it is longer than 12 or absent",
                cycles,
            ),
            self.column(
                "mismatch",
                "",
                "deviation from periodicity, relative to the rms",
                |one| one.mismatch,
            ),
        ])?;
        if self.resistance_ohm.is_some() {
            table.push(self.column(
                "mean_power_w",
                "W",
                "mean power; NaN where the segment is too short for an interval",
                |one| one.mean_power_w.unwrap_or(f64::NAN),
            ))?;
            table.push(self.column(
                "half_width_w",
                "W",
                "half width of its 95 % interval",
                |one| one.half_width_w.unwrap_or(f64::NAN),
            ))?;
        }
        self.add_solutions(&mut table)?;
        Ok(table)
    }

    fn column(
        &self,
        name: &str,
        unit: &str,
        about: &str,
        value: impl Fn(&SegmentResult) -> f64,
    ) -> Column {
        let values: Vec<f64> = self.segments.iter().map(value).collect();
        Column::new(name, unit, about, values)
    }

    /// Adds the match of each segment; nothing without a model.
    fn add_solutions(&self, table: &mut Table) -> Result<(), Error> {
        let solutions = self.segments.iter().map(|one| one.solution.clone());
        let Some(solutions) = solutions.collect::<Option<Vec<String>>>() else {
            return Ok(());
        };
        table.push(Column::new(
            "solution",
            "",
            "matching solution of the model",
            solutions,
        ))?;
        let nearest =
            |name: &str, unit: &str, about: &str, value: fn(&Candidate) -> Option<f64>| {
                self.column(name, unit, about, |one| {
                    let nearest = one.candidates.first();
                    nearest.and_then(value).unwrap_or(f64::NAN)
                })
            };
        table.push(nearest(
            "waveform_distance",
            "",
            "waveform distance of the nearest solution",
            |one| one.waveform_distance,
        ))?;
        table.push(nearest(
            "spectrum_distance",
            "",
            "spectrum distance of the nearest solution",
            |one| one.spectrum_distance,
        ))?;
        table.push(nearest(
            "model_power_w",
            "W",
            "mean power of the nearest solution",
            |one| Some(one.mean_power_w),
        ))?;
        Ok(())
    }

    /// Returns the figures with their names: the channel over time, one value per drive cycle, and
    /// the spectrum of each segment.
    ///
    /// # Errors
    /// [`Error::Signal`] and [`Error::Segmentation`] for samples that are no valid signal.
    pub fn figures(&self) -> Result<[(&'static str, Figure); 3], Error> {
        let samples = Samples::new(&self.values, self.rate_hz)?;
        let (channel, unit, found) = (&self.channel, &self.unit, &self.segmentation);
        let time = "Segments of one solution each";
        let section = "One value per drive cycle";
        let spectra = "Spectrum of each segment, Hann window";
        Ok([
            (
                "segments-time",
                segments(time, channel, unit, &samples, found),
            ),
            (
                "segments-section",
                segment_section(section, channel, unit, &samples, found, self.drive_hz),
            ),
            (
                "segments-spectra",
                segment_spectra(spectra, channel, unit, &samples, found, self.drive_hz)?,
            ),
        ])
    }
}
