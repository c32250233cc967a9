//! Tables and figure of a fit.

use super::FitResult;
use crate::error::Error;
use jounce_experiment::fit::{FittedCurve, FittedFeature, FittedKey};
use jounce_io::table::{Column, Table};
use jounce_plot::Figure;

impl FitResult {
    /// Returns the table of the keys.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let all = &self.estimate.keys;
        let text = |name: &str, about: &str, value: fn(&FittedKey) -> &String| {
            let values: Vec<String> = all.iter().map(|key| value(key).clone()).collect();
            Column::new(name, "", about, values)
        };
        let number = |name: &str, about: &str, value: fn(&FittedKey) -> f64| {
            Column::new(name, "", about, all.iter().map(value).collect::<Vec<f64>>())
        };
        Ok(Table::new(vec![
            text("key", "the key", |key| &key.key),
            text("unit", "unit of the next columns", |key| &key.unit),
            number("before", "value in the spec", |key| key.before),
            number("after", "fitted value", |key| key.after),
            number("low", "lower end of the 95 % interval", |key| key.low),
            number("high", "upper end of the 95 % interval", |key| key.high),
        ])?)
    }

    /// Returns the table of the features that are single numbers.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn features_table(&self) -> Result<Table, Error> {
        let all = &self.estimate.features;
        let names: Vec<String> = all.iter().map(|one| one.name.clone()).collect();
        let number = |name: &str, about: &str, value: fn(&FittedFeature) -> f64| {
            Column::new(name, "", about, all.iter().map(value).collect::<Vec<f64>>())
        };
        Ok(Table::new(vec![
            Column::new("feature", "", "the feature", names),
            number("measured", "measured value", |one| one.measured),
            number(
                "deviation",
                "relative standard deviation of the measurement",
                |one| one.deviation,
            ),
            number("before", "value of the model before", |one| one.before),
            number("after", "value of the model after", |one| one.after),
            number(
                "predicted_deviation",
                "relative deviation of the model after",
                |one| one.predicted_deviation,
            ),
            number("low", "lower end of the 95 % prediction interval", |one| {
                one.low
            }),
            number("high", "upper end of the 95 % prediction interval", |one| {
                one.high
            }),
        ])?)
    }

    /// Returns a table of each curve with the name of the curve.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn curve_tables(&self) -> Result<Vec<(String, Table)>, Error> {
        let curves = self.estimate.curves.iter();
        let table = |curve: &FittedCurve| Ok((curve.name.clone(), curve_table(curve)?));
        curves.map(table).collect()
    }

    /// Returns the figure of the features and curves before and after.
    pub fn figure(&self) -> Figure {
        let title = "Model against measurement, before and after the fit";
        jounce_experiment::draw::fitted(title, &self.estimate)
    }
}

fn curve_table(curve: &FittedCurve) -> Result<Table, Error> {
    let unit = if curve.over == "time_s" { "s" } else { "Hz" };
    let column = |name: &str, about: &str, values: &[f64]| {
        Column::new(name, &curve.unit, about, values.to_vec())
    };
    Ok(Table::new(vec![
        Column::new(&curve.over, unit, "place", curve.at.clone()),
        column("measured", "measured value", &curve.measured),
        column("before", "value of the model before", &curve.before),
        column("after", "value of the model after", &curve.after),
        column(
            "low",
            "lower end of the 95 % prediction interval",
            &curve.low,
        ),
        column(
            "high",
            "upper end of the 95 % prediction interval",
            &curve.high,
        ),
    ])?)
}
