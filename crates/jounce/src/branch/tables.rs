//! Tables of branches: points, bifurcations and half-power bandwidths.

use super::{Bifurcation, Branch, BranchPoint, BranchResult, band_limit_text};
use crate::error::Error;
use jounce_analysis::{BandInterval, PowerPeak};
use jounce_io::table::{Column, Table};

/// A branch with its peak, and an interval of its half-power bandwidth.
type IntervalRow = (String, PowerPeak, BandInterval);

impl BranchResult {
    /// Returns the table of every point of every branch.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let rows: Vec<(u64, &Branch, &BranchPoint)> = (0..)
            .zip(&self.branches)
            .flat_map(|(k, branch)| branch.points.iter().map(move |point| (k, branch, point)))
            .collect();
        let number = |name: &str, unit: &str, about: &str, value: fn(&BranchPoint) -> f64| {
            let values: Vec<f64> = rows.iter().map(|(.., point)| value(point)).collect();
            Column::new(name, unit, about, values)
        };
        let count = |name: &str, about: &str, value: fn(&(u64, &Branch, &BranchPoint)) -> u64| {
            Column::new(name, "", about, rows.iter().map(value).collect::<Vec<_>>())
        };
        let truth = |name: &str, about: &str, value: fn(&BranchPoint) -> bool| {
            let values: Vec<bool> = rows.iter().map(|(.., point)| value(point)).collect();
            Column::new(name, "", about, values)
        };
        let mut columns = vec![
            count("branch", "number of the branch, from 0", |(k, ..)| *k),
            count(
                "period_cycles",
                "period in drive cycles",
                |(_, branch, _)| u64::from(branch.period_cycles),
            ),
            number("parameter", &self.unit, &self.key, |point| point.parameter),
            number("mean_power_w", "W", "mean power of all loads", |point| {
                point.mean_power_w
            }),
            number(
                "voltage_rms_v",
                "V",
                "rms voltage of the first load, else of the output of the first rectifier",
                |point| point.voltage_rms_v,
            ),
            truth("stable", "attracts", |point| point.stable),
            truth(
                "stability_undecided",
                "a Floquet multiplier has modulus one within its error",
                |point| point.stability_undecided,
            ),
            number(
                "floquet_max_abs",
                "",
                "largest modulus of a Floquet multiplier",
                |point| point.floquet_max_abs,
            ),
            count(
                "contacts_per_period",
                "contacts per period",
                |(.., point)| point.contacts_per_period,
            ),
        ];
        columns.extend(displacement_columns(&rows));
        Ok(Table::new(columns)?)
    }

    /// Returns the table of every bifurcation.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn bifurcations_table(&self) -> Result<Table, Error> {
        let rows: Vec<(u64, &Bifurcation)> = (0..)
            .zip(&self.branches)
            .flat_map(|(k, branch)| branch.bifurcations.iter().map(move |one| (k, one)))
            .collect();
        let number = |name: &str, unit: &str, about: &str, value: fn(&Bifurcation) -> f64| {
            let values: Vec<f64> = rows.iter().map(|(_, one)| value(one)).collect();
            Column::new(name, unit, about, values)
        };
        let branch: Vec<u64> = rows.iter().map(|(k, _)| *k).collect();
        let kind = |(_, one): &(u64, &Bifurcation)| one.kind.name().to_owned();
        let kind: Vec<String> = rows.iter().map(kind).collect();
        Ok(Table::new(vec![
            Column::new("branch", "", "number of the branch, from 0", branch),
            Column::new("kind", "", "kind of the bifurcation", kind),
            number("parameter", &self.unit, &self.key, |one| one.parameter),
            number(
                "parameter_error",
                &self.unit,
                "estimated error of the value of the key",
                |one| one.parameter_error.unwrap_or(f64::NAN),
            ),
            number("mean_power_w", "W", "mean power of all loads", |one| {
                one.mean_power_w
            }),
            number(
                "displacement_peak_m",
                "m",
                "half the peak-to-peak displacement at the first stop",
                |one| one.displacement_peak_m,
            ),
        ])?)
    }

    /// Returns the table of the half-power intervals of each branch, and of all branches combined.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn bandwidths_table(&self) -> Result<Table, Error> {
        let rows = self.interval_rows();
        let unit = self.unit.as_str();
        let number = |name: &str, unit: &str, about: &str, value: fn(&IntervalRow) -> f64| {
            Column::new(
                name,
                unit,
                about,
                rows.iter().map(value).collect::<Vec<_>>(),
            )
        };
        let text = |name: &str, about: &str, value: fn(&IntervalRow) -> String| {
            Column::new(name, "", about, rows.iter().map(value).collect::<Vec<_>>())
        };
        Ok(Table::new(vec![
            text(
                "branch",
                "number of the branch, from 0; `all` for all branches combined",
                |row| row.0.clone(),
            ),
            number(
                "peak_parameter",
                unit,
                "parameter of the stable orbit with the largest power",
                |row| row.1.parameter,
            ),
            number("peak_mean_power_w", "W", "largest mean power", |row| {
                row.1.mean_power_w
            }),
            number(
                "from",
                unit,
                "lower end of a range with at least half of the largest power",
                |row| row.2.from.parameter,
            ),
            number(
                "from_error",
                unit,
                "estimated error of the lower end",
                |row| row.2.from.parameter_error,
            ),
            text("from_at", "limit at the lower end", |row| {
                band_limit_text(row.2.from.at).to_owned()
            }),
            number("to", unit, "upper end of the range", |row| {
                row.2.to.parameter
            }),
            number(
                "to_error",
                unit,
                "estimated error of the upper end",
                |row| row.2.to.parameter_error,
            ),
            text("to_at", "limit at the upper end", |row| {
                band_limit_text(row.2.to.at).to_owned()
            }),
        ])?)
    }

    /// Returns the half-power intervals of each branch, then of all branches combined.
    fn interval_rows(&self) -> Vec<IntervalRow> {
        let of_branch = |(k, branch): (usize, &'_ Branch)| {
            let bandwidth = branch.half_power_bandwidth.clone();
            (k.to_string(), branch.peak, bandwidth)
        };
        let all = (
            "all".to_owned(),
            self.peak,
            self.half_power_bandwidth.clone(),
        );
        let bandwidths = self.branches.iter().enumerate().map(of_branch);
        let mut rows = Vec::new();
        for (name, peak, bandwidth) in bandwidths.chain([all]) {
            if let (Some(peak), Some(bandwidth)) = (peak, bandwidth) {
                let row = |interval| (name.clone(), peak, interval);
                rows.extend(bandwidth.intervals.into_iter().map(row));
            }
        }
        rows
    }
}

/// Returns the columns of penetration, displacement and error.
fn displacement_columns(rows: &[(u64, &Branch, &BranchPoint)]) -> [Column; 3] {
    let number = |name: &str, unit: &str, about: &str, value: fn(&BranchPoint) -> f64| {
        let values: Vec<f64> = rows.iter().map(|(.., point)| value(point)).collect();
        Column::new(name, unit, about, values)
    };
    [
        number(
            "max_penetration_m",
            "m",
            "largest penetration of the stop",
            |point| point.max_penetration_m,
        ),
        number(
            "displacement_peak_m",
            "m",
            "half the peak-to-peak displacement at the first stop",
            |point| point.displacement_peak_m,
        ),
        number(
            "error_estimate",
            "",
            "larger of the estimated relative errors of the state and the mean power",
            |point| point.error_estimate,
        ),
    ]
}
