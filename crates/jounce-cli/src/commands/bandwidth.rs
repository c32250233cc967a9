//! Output of peaks and half-power bandwidths by `jounce branch`.

use crate::failure::Failure;
use crate::output::{key_value, line};
use jounce_core::analysis::{BandLimit, Bandwidth, Bandwidths, IntervalEdge};
use jounce_core::spec::NumericKey;
use jounce_core::table::{Column, Table};

/// Converts the width, its error and its intervals; the peak is a separate key.
pub fn to_json(width: &Bandwidth) -> serde_json::Value {
    serde_json::json!({ "width": width.width, "width_error": width.width_error, "intervals": width.intervals })
}

/// Prints the bandwidth as lines of text.
pub fn print(width: &Bandwidth, unit: &str) {
    let peak = &width.peak;
    line(format!(
        "  {:<16} {:>12} {unit}  {:.6e} W  ({})",
        "largest stable",
        key_value(peak.parameter),
        peak.mean_power_w,
        limit_name(peak.at)
    ));
    line(format!(
        "  {:<16} {:>12} {unit}  +- {:.1e}",
        "half-power width",
        key_value(width.width),
        width.width_error
    ));
    for interval in &width.intervals {
        let (from, to) = (&interval.from, &interval.to);
        line(format!(
            "    from {} ({}) to {} {unit} ({})",
            key_value(from.parameter),
            limit_name(from.at),
            key_value(to.parameter),
            limit_name(to.at)
        ));
    }
}

/// Describes a limit of a band.
fn limit_name(limit: BandLimit) -> &'static str {
    match limit {
        BandLimit::Maximum => "maximum",
        BandLimit::HalfPower => "half power",
        BandLimit::Stability => "stability lost",
        BandLimit::End => "end of the branch",
    }
}

/// A branch with its bandwidth, and both ends of an interval.
type Row<'w> = (String, &'w Bandwidth, IntervalEdge, IntervalEdge);

/// Returns a table with one row for each interval of each branch, and of all branches combined.
pub fn table(key: &NumericKey, widths: &Bandwidths) -> Result<Table, Failure> {
    let branch_widths = widths
        .branches
        .iter()
        .enumerate()
        .map(|(k, width)| (k.to_string(), width));
    let rows: Vec<Row> = (branch_widths.chain([("all".to_owned(), &widths.together)]))
        .filter_map(|(name, width)| Some((name, width.as_ref()?)))
        .flat_map(|(name, width)| {
            width
                .intervals
                .iter()
                .map(move |interval| (name.clone(), width, interval.from, interval.to))
        })
        .collect();
    let number = |name: &str, unit: &str, about: &str, value: &dyn Fn(&Row) -> f64| {
        Column::new(
            name,
            unit,
            about,
            rows.iter().map(value).collect::<Vec<f64>>(),
        )
    };
    let text = |name: &str, about: &str, value: &dyn Fn(&Row) -> String| {
        Column::new(
            name,
            "",
            about,
            rows.iter().map(value).collect::<Vec<String>>(),
        )
    };
    let unit = key.unit();
    Ok(Table::new(vec![
        text(
            "branch",
            "number of the branch, from 0; `all` for all branches combined",
            &|row| row.0.clone(),
        ),
        number(
            "peak_parameter",
            &unit,
            "parameter of the stable orbit with the largest power",
            &|row| row.1.peak.parameter,
        ),
        number("peak_mean_power_w", "W", "largest mean power", &|row| {
            row.1.peak.mean_power_w
        }),
        number(
            "from",
            &unit,
            "lower end of a range with at least half of the largest power",
            &|row| row.2.parameter,
        ),
        number(
            "from_error",
            &unit,
            "estimated error of the lower end",
            &|row| row.2.parameter_error,
        ),
        text("from_at", "limit at the lower end", &|row| {
            limit_name(row.2.at).to_owned()
        }),
        number("to", &unit, "upper end of the range", &|row| {
            row.3.parameter
        }),
        number(
            "to_error",
            &unit,
            "estimated error of the upper end",
            &|row| row.3.parameter_error,
        ),
        text("to_at", "limit at the upper end", &|row| {
            limit_name(row.3.at).to_owned()
        }),
    ])?)
}
