//! Table and figure of the response to noise.

use super::NoiseResult;
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{DensityLine, Figure, densities};

impl NoiseResult {
    /// Returns the table of the power spectral densities over frequency.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let frequency = Column::new("frequency_hz", "Hz", "frequency", self.frequency_hz.clone());
        let mut table = Table::new(vec![frequency])?;
        for density in &self.densities {
            let name = format!("{}.psd", density.name);
            let about = "power spectral density, one-sided, without contact";
            let values = density.value.clone();
            table.push(Column::new(&name, density.unit, about, values))?;
        }
        Ok(table)
    }

    /// Returns the figure of the power spectral densities.
    pub fn figure(&self) -> Figure {
        let lines = self.densities.iter().map(|density| DensityLine {
            quantity: density.name.clone(),
            unit: density.unit.to_owned(),
            density: density.value.clone(),
            interval: [Vec::new(), Vec::new()],
        });
        let lines: Vec<DensityLine> = lines.collect();
        let title = "Power spectral densities, no contact";
        densities(title, &self.frequency_hz, &lines)
    }
}
