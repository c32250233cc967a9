//! Table and figure of sensitivities.

use super::SensitivityResult;
use crate::error::Error;
use jounce_io::table::{Column, Table};
use jounce_plot::{Axis, Figure, Marker, Panel, Series};

/// Keys of the figure.
const SHOWN: usize = 20;

impl SensitivityResult {
    /// Returns the table of the keys, with the relative derivative of each result.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let names: Vec<String> = self.keys.iter().map(|one| one.key.clone()).collect();
        let units: Vec<String> = self.keys.iter().map(|one| one.unit.clone()).collect();
        let values: Vec<f64> = self.keys.iter().map(|one| one.value).collect();
        let mut columns = vec![
            Column::new("key", "", "key", names),
            Column::new("unit", "", "SI unit of the key", units),
            Column::new("value", "", "value of the key, SI", values),
        ];
        for (index, quantity) in self.quantities.iter().enumerate() {
            let relative: Vec<f64> = self
                .keys
                .iter()
                .map(|one| one.derivatives[index].relative)
                .collect();
            let about = "relative change of the result per relative change of the key";
            columns.push(Column::new(&quantity.name, "", about, relative));
        }
        let error: Vec<f64> = self
            .keys
            .iter()
            .map(|one| one.derivatives[0].relative_error)
            .collect();
        let about = "estimated error of the relative change of mean power";
        columns.push(Column::new("mean_power_error", "", about, error));
        Ok(Table::new(columns)?)
    }

    /// Returns the figure of the relative derivatives of the mean power, the largest first.
    pub fn figure(&self) -> Figure {
        let shown = &self.keys[..SHOWN.min(self.keys.len())];
        let top = shown.len() as f64 + 1.0;
        let x = Axis::linear("Change of mean power for 1 % more of the key", "%");
        let y = Axis {
            range: Some((0.0, top)),
            // Each bar has the name of its key.
            step: Some(2.0 * top),
            ..Axis::linear("Keys, the largest change at the top", "")
        };
        let mut panel = Panel::new(x, y).high(60.0 + 18.0 * top);
        for (number, one) in shown.iter().enumerate() {
            let (relative, row) = (one.derivatives[0].relative, top - number as f64 - 1.0);
            let bar = Series::line(vec![0.0, relative], vec![row, row]);
            panel = panel
                .with(bar)
                .with(Series::points(vec![relative], vec![row], Marker::Circle))
                .note(relative, row, &one.key);
        }
        Figure::new("Sensitivity of the mean power").with(panel)
    }
}
