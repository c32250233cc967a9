//! Tables of measured modes.

use super::{ComplexValues, MeasuredMode, MeasuredModesResult};
use crate::error::Error;
use jounce_identification::modal::{Stability, StablePole};
use jounce_io::table::{Column, Table, Values};

impl MeasuredModesResult {
    /// Returns the table of the modes and their shapes.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let mut table = Table::new(vec![
            self.frequency(),
            self.column(
                "frequency_deviation_hz",
                "Hz",
                "standard deviation of the frequency",
                |mode| mode.frequency_deviation_hz,
            ),
            self.column("damping_ratio", "", "damping ratio", |mode| {
                mode.damping_ratio
            }),
            self.column(
                "damping_deviation",
                "",
                "standard deviation of the damping ratio",
                |mode| mode.damping_deviation,
            ),
            self.column(
                "quantile_95",
                "",
                "half width of the 95 % interval in standard deviations",
                |mode| mode.quantile_95,
            ),
        ])?;
        let about = "shape, normalised to 1 at the largest response";
        self.push_complex(&mut table, &self.responses, "shape", about, |mode| {
            &mode.shape
        })?;
        let about = "participation of a force, by reciprocity the shape at its point, normalised to 1 at the largest";
        self.push_complex(
            &mut table,
            &self.references,
            "participation",
            about,
            |mode| &mode.participation,
        )?;
        Ok(table)
    }

    /// Returns the table of the modal assurance criterion.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn mac_table(&self) -> Result<Table, Error> {
        let mut table = Table::new(vec![self.frequency()])?;
        for (k, row) in (1..).zip(&self.mac) {
            let about = "modal assurance criterion with this mode";
            table.push(Column::new(&format!("mode_{k}"), "", about, row.clone()))?;
        }
        Ok(table)
    }

    /// Returns the table of the stabilisation diagram.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn stabilisation_table(&self) -> Result<Table, Error> {
        let poles = &self.stabilisation;
        let column = |name: &str, unit: &str, about: &str, values: Values| {
            Column::new(name, unit, about, values)
        };
        let number = |value: fn(&StablePole) -> f64| {
            Values::from(poles.iter().map(value).collect::<Vec<f64>>())
        };
        let order: Vec<u64> = poles.iter().map(|pole| pole.order as u64).collect();
        let stable = |pole: &StablePole| match pole.stable {
            Stability::New => "new".to_owned(),
            Stability::Frequency => "frequency".to_owned(),
            Stability::Pole => "pole".to_owned(),
        };
        let stable: Vec<String> = poles.iter().map(stable).collect();
        Ok(Table::new(vec![
            column("order", "", "order of the denominator", order.into()),
            column(
                "frequency_hz",
                "Hz",
                "frequency of the pole",
                number(|pole| pole.pole.frequency_hz),
            ),
            column(
                "damping_ratio",
                "",
                "damping ratio of the pole",
                number(|pole| pole.pole.damping_ratio),
            ),
            column(
                "stable",
                "",
                "agreement with the order below",
                stable.into(),
            ),
        ])?)
    }

    fn frequency(&self) -> Column {
        let about = "undamped natural frequency";
        self.column("frequency_hz", "Hz", about, |mode| mode.frequency_hz)
    }

    fn column(
        &self,
        name: &str,
        unit: &str,
        about: &str,
        value: impl Fn(&MeasuredMode) -> f64,
    ) -> Column {
        let values: Vec<f64> = self.modes.iter().map(value).collect();
        Column::new(name, unit, about, values)
    }

    /// Adds the real and the imaginary part of a complex number at each point.
    fn push_complex(
        &self,
        table: &mut Table,
        points: &[String],
        what: &str,
        about: &str,
        value: fn(&MeasuredMode) -> &ComplexValues,
    ) -> Result<(), Error> {
        for (k, point) in points.iter().enumerate() {
            let name = format!("{point}.{what}");
            let re = |mode: &MeasuredMode| value(mode).re[k];
            let im = |mode: &MeasuredMode| value(mode).im[k];
            table.push(self.column(&format!("{name}.re"), "", about, re))?;
            table.push(self.column(&format!("{name}.im"), "", about, im))?;
        }
        Ok(())
    }
}
