//! Converts arrays to recordings. Each array is assigned to the nearest time or frequency array of
//! equal length among the structs of the file.
//!
//! The nearest array shares the most names, counted from the outermost: `data.run(2).acc` belongs
//! to `data.run(2).t` rather than to `data.t`. Without such an array, a rate or step stored in the
//! same struct gives the times. Recordings over equal grids are merged.

use std::collections::HashMap;
use std::io;

use super::axes::{RecordingSet, SampleAxis, assign_to_axes};
use super::nearest::NearestByName;
use super::sorted::{SortedArrays, is_only_in_scope};
use super::spacing::{Spacing, spacings};
use super::{Array, Path, Tree};
use crate::read::column::raw::{Rate, Raw, RawColumn, TimeStamps};
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::recording::{Issue, IssueKind, Over};

/// Maximum number of skipped arrays that are listed by name.
const MAX_NAMED: usize = 8;

/// Builds the recordings of a file of arrays.
pub(in crate::read) fn into_found(mut tree: Tree) -> Result<FormatContents, Damage> {
    let arrays = std::mem::take(&mut tree.arrays);
    let (scalars, arrays): (Vec<Array>, Vec<Array>) = arrays
        .into_iter()
        .filter(|array| array.length() > 0)
        .partition(is_single);
    if arrays.is_empty() {
        let skipped_text = if tree.issues.is_empty() {
            String::new()
        } else {
            format!(" ({})", tree.issues[0].about)
        };
        return Err(Damage::new(format!(
            "it contains no numeric array that could be a recording{skipped_text}; is the file truncated?"
        )));
    }
    let spacings = spacings(&scalars, &mut tree)?;
    let is_alone = is_only_in_scope(&arrays)?;
    let (mut sets, excluded) =
        assign_to_axes(&tree, SortedArrays::new(arrays)?, &spacings, &is_alone);
    drop_empty_sets(&mut sets, &mut tree);
    report_excluded(&mut tree, &excluded, &sets);
    let sets = merge_sets(sets)?;
    let has_several_sets = sets.len() > 1;
    let (issues, mut of_set) = if has_several_sets {
        (tree.issues, Vec::new())
    } else {
        (Vec::new(), tree.issues)
    };
    let mut rates = NearestByName::default();
    spacings
        .iter()
        .enumerate()
        .for_each(|(k, spacing)| rates.insert(spacing.over, &spacing.scope, k));
    let raws = sets.into_iter().map(|set| {
        let rate = rates
            .nearest(&[Over::Time], &set.scope)
            .map(|k| spacings[k].rate.clone());
        raw(set, rate, std::mem::take(&mut of_set))
    });
    Ok(FormatContents {
        sets: raws.collect(),
        shapes: Vec::new(),
        issues,
    })
}

/// Removes sets without a channel and reports their times. If no set has a channel, the longest
/// times remain, which are refused later, with a list of what was left out.
fn drop_empty_sets(sets: &mut Vec<RecordingSet>, tree: &mut Tree) {
    sets.retain(|set| !set.columns.is_empty() || !matches!(set.axis, SampleAxis::Even(_)));
    if sets.iter().any(|set| !set.columns.is_empty()) {
        for set in sets.iter().filter(|set| set.columns.is_empty()) {
            if let SampleAxis::Array(axis, _) = &set.axis {
                tree.skip(format!(
                    "{} has {} samples, and no channel has the same length",
                    axis.name, set.length
                ));
            }
        }
        sets.retain(|set| !set.columns.is_empty());
    } else {
        sets.sort_by_key(|set| std::cmp::Reverse(set.length));
        sets.truncate(1);
    }
}

fn is_single(array: &Array) -> bool {
    array.length() == 1 && array.series.len() == 1
}

/// Merges recordings over equal grids.
fn merge_sets(sets: Vec<RecordingSet>) -> io::Result<Vec<RecordingSet>> {
    let mut merged: Vec<RecordingSet> = Vec::new();
    let mut by_key: HashMap<(Over, usize, [u64; 3]), Vec<usize>> = HashMap::new();
    for set in sets {
        let key = match &set.axis {
            SampleAxis::Array(axis, over) => {
                let (first, last) = axis.values.first_and_last()?.unwrap_or_default();
                (*over, set.length, [first.to_bits(), last.to_bits(), 0])
            }
            SampleAxis::Even(spacing) => {
                let start = spacing.start.map_or(u64::MAX, f64::to_bits);
                (
                    spacing.over,
                    set.length,
                    [start, spacing.rate.rate_hz.to_bits(), 1],
                )
            }
            SampleAxis::Unknown => (Over::Time, set.length, [0, 0, 2]),
        };
        let candidates = by_key.entry(key).or_default();
        let mut at = None;
        for number in candidates.iter().copied() {
            if at.is_none() && has_equal_axis(&merged[number].axis, &set.axis)? {
                at = Some(number);
            }
        }
        match at {
            Some(number) => merged[number].columns.extend(set.columns),
            None => {
                candidates.push(merged.len());
                merged.push(set);
            }
        }
    }
    Ok(merged)
}

fn has_equal_axis(a: &SampleAxis, b: &SampleAxis) -> io::Result<bool> {
    match (a, b) {
        (SampleAxis::Array(a, _), SampleAxis::Array(b, _)) => {
            Ok(a.unit == b.unit && a.values.equals(&b.values)?)
        }
        _ => Ok(true),
    }
}

fn raw(set: RecordingSet, rate: Option<Rate>, issues: Vec<Issue>) -> Raw {
    let RecordingSet {
        axis,
        scope,
        mut columns,
        ..
    } = set;
    number_duplicates(&mut columns);
    let title = Path(scope).to_string();
    let (over, stamps) = match axis {
        SampleAxis::Array(axis, over) => {
            columns.insert(0, *axis);
            (
                over,
                TimeStamps::FromColumn {
                    column: 0,
                    rate: rate.filter(|_| over == Over::Time),
                },
            )
        }
        SampleAxis::Even(Spacing {
            rate, start, over, ..
        }) => match (start, over) {
            (None, Over::Time) => (over, TimeStamps::Rate(rate)),
            _ => (
                over,
                TimeStamps::Even {
                    start: start.unwrap_or_default(),
                    step: 1.0 / rate.rate_hz,
                },
            ),
        },
        SampleAxis::Unknown => (Over::Time, TimeStamps::Column),
    };
    Raw {
        title,
        over,
        stamps,
        columns,
        issues,
    }
}

/// Numbers the columns that share a name given by texts of the file.
fn number_duplicates(columns: &mut [RawColumn]) {
    let mut times: HashMap<String, (usize, usize)> = HashMap::new();
    columns
        .iter()
        .for_each(|column| times.entry(column.name.clone()).or_default().0 += 1);
    for column in columns {
        if let Some((2.., number)) = times.get_mut(&column.name) {
            *number += 1;
            column.name = format!("{} ({number})", column.name);
        }
    }
}

/// Records which arrays were left out.
fn report_excluded(tree: &mut Tree, excluded: &[(String, usize)], sets: &[RecordingSet]) {
    let record = match sets {
        [set] => format!("where the recording has {}", set.length),
        _ => "and no time or frequency in the file has the same length".to_owned(),
    };
    for (name, length) in excluded.iter().take(MAX_NAMED) {
        tree.skip(format!("{name} has {length} samples {record}"));
    }
    if let Some(unlisted) = excluded
        .len()
        .checked_sub(MAX_NAMED)
        .filter(|unlisted| *unlisted > 0)
    {
        let message = "arrays of other lengths than the recording were left out".to_owned();
        tree.issues
            .push(Issue::new(IssueKind::Skipped, unlisted, None, message));
    }
}
