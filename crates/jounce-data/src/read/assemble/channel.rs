//! Channels in SI units from columns as written in the file.

use crate::read::column::raw::RawColumn;
use crate::read::heading::decibels::Decibels;
use crate::read::{ChannelNotes, ChannelSummary};
use crate::recording::{Issue, IssueKind, Quantity, Series as _, Sizes, Unit};

/// Column in SI units, before inspection of its samples.
pub(in crate::read) fn channel_summary(
    mut column: RawColumn,
    column_notes: ChannelNotes,
    issues: &mut Vec<Issue>,
) -> ChannelSummary {
    if let Some(levels) = Decibels::read(&column.unit) {
        issues.push(column.convert_levels(levels));
    }
    let name = column_notes.name.unwrap_or(column.name);
    let unit_text = column_notes.unit.unwrap_or(column.unit);
    let scale = column_notes.scale.unwrap_or(1.0);
    let unit = Unit::read(&unit_text);
    let factor = scale * unit.as_ref().map_or(1.0, |unit| unit.factor);
    let of_unit = unit_issues(&unit_text, unit.as_ref(), column.values.count());
    issues.extend(of_unit.into_iter().map(|issue| issue.of(&name)));
    let (quantity, unit) = unit.map_or((Quantity::Unknown, unit_text.clone()), |unit| {
        (unit.quantity, unit.si.into_owned())
    });
    let RawColumn {
        mut values,
        mut imaginary,
        ..
    } = column;
    values.scale(factor);
    imaginary
        .iter_mut()
        .for_each(|numbers| numbers.scale(factor));
    let (place, direction) = (
        column_notes.place.unwrap_or(column.place),
        column_notes.direction.unwrap_or(column.direction),
    );
    let reference = column_notes.reference.unwrap_or(column.reference);
    let sizes = Sizes {
        rms: f64::NAN,
        peak: f64::NAN,
        mean: f64::NAN,
    };
    ChannelSummary {
        name,
        quantity,
        unit,
        place,
        direction,
        reference,
        sizes,
        values,
        imaginary,
    }
}

/// Reports a unit that is converted to SI, is not known, or has characters outside ASCII.
fn unit_issues(unit_text: &str, unit: Option<&Unit>, count: usize) -> Vec<Issue> {
    let mut issues = Vec::new();
    let mut report = |kind, count, message| issues.push(Issue::new(kind, count, None, message));
    if !unit_text.is_ascii() {
        let message = format!("the unit {unit_text:?} contains characters outside ASCII");
        report(IssueKind::NonAsciiUnit, 1, message);
    }
    if let Some(unit) = unit.filter(|unit| unit.converts()) {
        let message = format!(
            "values in {unit_text} are multiplied by {} to give {}",
            unit.factor, unit.si
        );
        report(IssueKind::Converted, count, message);
    }
    if unit.is_none() && !unit_text.trim().is_empty() && unit_text.trim() != "NONE" {
        let message = format!("the unit {unit_text:?} is not known; values are unchanged");
        report(IssueKind::UnknownUnit, 1, message);
    }
    issues
}
