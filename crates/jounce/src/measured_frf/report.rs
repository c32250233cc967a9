//! Table and figure of the frequency responses of a hammer or shaker test.

use super::{MeasuredFrfResult, MeasuredResponse};
use crate::error::Error;
use jounce_experiment::draw::measured_responses;
use jounce_io::table::{Column, Table};
use jounce_plot::Figure;

impl MeasuredFrfResult {
    /// Returns the table of the responses and their coherence.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let frequency_hz = self.frequency_hz.clone();
        let mut table = Table::new(vec![Column::new(
            "frequency_hz",
            "Hz",
            "frequency",
            frequency_hz,
        )])?;
        for response in &self.responses {
            let MeasuredResponse { name, unit, .. } = response;
            for (part, unit, about, values) in [
                ("re", unit.as_str(), "real part", &response.re),
                ("im", unit.as_str(), "imaginary part", &response.im),
                ("coherence", "", "coherence", &response.coherence),
            ] {
                let name = format!("{name}.{part}");
                table.push(Column::new(&name, unit, about, values.clone()))?;
            }
        }
        Ok(table)
    }

    /// Returns the figure of the responses.
    pub fn figure(&self) -> Figure {
        measured_responses("Measured frequency responses", &self.data)
    }
}

impl MeasuredResponse {
    /// Returns the line with the largest magnitude, without the one at 0 Hz, which contains the
    /// offset of the sensor: its index and its magnitude.
    pub fn highest(&self) -> Option<(usize, f64)> {
        let lines = self.re.iter().zip(&self.im).enumerate().skip(1);
        let magnitudes = lines.map(|(k, (re, im))| (k, re.hypot(*im)));
        magnitudes.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}
