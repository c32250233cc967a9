//! Table and figures of frequency responses.

use super::FrfResult;
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{Figure, ResponseLine, Scale, frequency_responses};

impl FrfResult {
    /// Returns the table of the real and imaginary parts over frequency.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let frequency = Column::new("frequency_hz", "Hz", "frequency", self.frequency_hz.clone());
        let mut table = Table::new(vec![frequency])?;
        for response in &self.responses {
            let name = &response.name;
            for (suffix, about, values) in [
                ("re", "real part", &response.re),
                ("im", "imaginary part", &response.im),
            ] {
                let name = format!("{name}.{suffix}");
                table.push(Column::new(&name, response.unit, about, values.clone()))?;
            }
        }
        Ok(table)
    }

    /// Returns a figure of each response with its name.
    pub fn figures(&self) -> Vec<(String, Figure)> {
        let figures = self.responses.iter().map(|response| {
            let name = &response.name;
            let line = ResponseLine {
                label: name.clone(),
                re: response.re.clone(),
                im: response.im.clone(),
            };
            let (unit, hz) = (response.unit, &self.frequency_hz);
            let title = match response.is_zero() {
                true => format!("{name}: 0 at every frequency"),
                false => name.clone(),
            };
            let figure = frequency_responses(&title, name, unit, Scale::Log, hz, &[line]);
            (format!("frf-{name}"), figure)
        });
        figures.collect()
    }
}
