//! Tables of `jounce branch`.

use crate::failure::Failure;
use jounce_core::analysis::{Bifurcation, Branch as Curve, BranchPoint};
use jounce_core::spec::NumericKey;
use jounce_core::table::{Column, Table};

/// Returns the table of every point of every branch.
pub fn points_table(key: &NumericKey, branches: &[Curve]) -> Result<Table, Failure> {
    let rows: Vec<(usize, &Curve, &BranchPoint)> = branches
        .iter()
        .enumerate()
        .flat_map(|(k, branch)| branch.points.iter().map(move |point| (k, branch, point)))
        .collect();
    let number = |name: &str, unit: &str, about: &str, value: fn(&BranchPoint) -> f64| {
        Column::new(
            name,
            unit,
            about,
            rows.iter()
                .map(|(_, _, point)| value(point))
                .collect::<Vec<f64>>(),
        )
    };
    let count = |name: &str, about: &str, value: fn(&(usize, &Curve, &BranchPoint)) -> u64| {
        Column::new(
            name,
            "",
            about,
            rows.iter().map(value).collect::<Vec<u64>>(),
        )
    };
    Ok(Table::new(vec![
        count("branch", "number of the branch, from 0", |(k, _, _)| {
            *k as u64
        }),
        count(
            "period_cycles",
            "period in drive cycles",
            |(_, branch, _)| u64::from(branch.period_cycles),
        ),
        number("parameter", &key.unit(), key.path(), |p| p.parameter),
        number("mean_power_w", "W", "mean power of all loads", |p| {
            p.orbit.mean_power_w
        }),
        number(
            "voltage_rms_v",
            "V",
            "rms voltage of the first load, else of the output of the first rectifier",
            |p| p.orbit.voltage_rms_v,
        ),
        Column::new(
            "stable",
            "",
            "attracts",
            rows.iter()
                .map(|(_, _, p)| p.orbit.is_stable())
                .collect::<Vec<bool>>(),
        ),
        Column::new(
            "stability_undecided",
            "",
            "a Floquet multiplier has modulus one within its error",
            rows.iter()
                .map(|(_, _, p)| p.orbit.is_stability_undecided())
                .collect::<Vec<bool>>(),
        ),
        number(
            "floquet_max_abs",
            "",
            "largest modulus of a Floquet multiplier",
            |p| p.orbit.floquet_max_abs(),
        ),
        count("contacts_per_period", "contacts per period", |(_, _, p)| {
            p.orbit.contacts
        }),
        number(
            "max_penetration_m",
            "m",
            "largest penetration of the stop",
            |p| p.orbit.max_penetration_m,
        ),
        number(
            "displacement_peak_m",
            "m",
            "half the peak-to-peak displacement at the first stop",
            |p| p.orbit.displacement_peak_m,
        ),
        number(
            "error_estimate",
            "",
            "larger of the estimated relative errors of the state and the mean power",
            |p| p.orbit.error_estimate,
        ),
    ])?)
}

/// Returns the table of every bifurcation.
pub fn bifurcations_table(key: &NumericKey, branches: &[Curve]) -> Result<Table, Failure> {
    let rows: Vec<(u64, &Bifurcation)> = branches
        .iter()
        .enumerate()
        .flat_map(|(k, branch)| {
            branch
                .bifurcations
                .iter()
                .map(move |bifurcation| (k as u64, bifurcation))
        })
        .collect();
    let number = |name: &str, unit: &str, about: &str, value: fn(&BranchPoint) -> f64| {
        Column::new(
            name,
            unit,
            about,
            rows.iter()
                .map(|(_, bifurcation)| value(&bifurcation.at))
                .collect::<Vec<f64>>(),
        )
    };
    Ok(Table::new(vec![
        Column::new(
            "branch",
            "",
            "number of the branch, from 0",
            rows.iter().map(|(k, _)| *k).collect::<Vec<u64>>(),
        ),
        Column::new(
            "kind",
            "",
            "kind of the bifurcation",
            rows.iter()
                .map(|(_, bifurcation)| bifurcation.kind.name().to_owned())
                .collect::<Vec<_>>(),
        ),
        number("parameter", &key.unit(), key.path(), |p| p.parameter),
        number("mean_power_w", "W", "mean power of all loads", |p| {
            p.orbit.mean_power_w
        }),
        number(
            "displacement_peak_m",
            "m",
            "half the peak-to-peak displacement at the first stop",
            |p| p.orbit.displacement_peak_m,
        ),
    ])?)
}
