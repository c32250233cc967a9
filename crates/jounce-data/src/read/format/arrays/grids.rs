//! Converts arrays to recordings. Each array is assigned to the nearest time or frequency array of
//! equal length among the structs of the file.
//!
//! The nearest array shares the most names, counted from the outermost: `data.run(2).acc` belongs
//! to `data.run(2).t` rather than to `data.t`. Without such an array, a rate or step stored in the
//! same struct gives the times. Recordings over equal grids are merged.

use std::collections::HashMap;
use std::hash::Hash;
use std::io;

use super::names::heads;
use super::spacing::{Spacing, spacings};
use super::{Array, Path, Tree};
use crate::read::column::raw::{Rate, Raw, RawColumn, TimeStamps};
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::heading::name::{is_frequency, is_time, split};
use crate::recording::{Issue, IssueKind, Over, Series};

/// Maximum number of skipped arrays that are listed by name.
const MAX_NAMED: usize = 8;

/// Source of the sample positions of a recording.
enum SampleAxis {
    /// Positions stored in an array.
    Array(Box<RawColumn>, Over),
    /// Uniform grid given by a scalar.
    Even(Spacing),
    /// No information in the file.
    Unknown,
}

/// Recording under construction.
struct RecordingSet {
    axis: SampleAxis,
    length: usize,
    scope: Vec<String>,
    columns: Vec<RawColumn>,
}

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
        // Times without a channel of their length: the longest is refused later, with a list of
        // what was left out.
        sets.sort_by_key(|set| std::cmp::Reverse(set.length));
        sets.truncate(1);
    }
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

fn is_single(array: &Array) -> bool {
    array.length() == 1 && array.series.len() == 1
}

/// True for each array that is the only data array in its struct. Texts of that struct then apply
/// to it.
fn is_only_in_scope(arrays: &[Array]) -> io::Result<HashMap<Path, bool>> {
    let mut in_scope: HashMap<&[String], usize> = HashMap::new();
    let is_axis = |array: &Array| over_by_name(array).is_some();
    for array in arrays.iter().filter(|array| !is_axis(array)) {
        *in_scope.entry(array.path.scope()).or_default() += 1;
    }
    Ok(arrays
        .iter()
        .map(|array| {
            (
                array.path.clone(),
                !is_axis(array) && in_scope.get(array.path.scope()) == Some(&1),
            )
        })
        .collect())
}

/// Independent variable (time or frequency) that the name of a real series indicates.
fn over_by_name(array: &Array) -> Option<Over> {
    let one = array.series.len() == 1 && array.imaginary.is_none();
    let (name, _) = split(array.path.name());
    let over = if is_time(&name) || is_time(array.path.name()) {
        Over::Time
    } else {
        Over::Frequency
    };
    let has_axis_name =
        over == Over::Time || is_frequency(&name) || is_frequency(array.path.name());
    (one && has_axis_name).then_some(over)
}

/// Arrays of times or frequencies, and all others.
#[derive(Default)]
struct SortedArrays {
    axes: Vec<(Array, Over)>,
    channels: Vec<Array>,
}

impl SortedArrays {
    fn new(arrays: Vec<Array>) -> io::Result<Self> {
        let mut sorted = Self::default();
        for array in arrays {
            match over_by_name(&array) {
                Some(over) if is_ascending(&array)? => sorted.axes.push((array, over)),
                _ => sorted.channels.push(array),
            }
        }
        Ok(sorted)
    }
}

fn is_ascending(array: &Array) -> io::Result<bool> {
    let (mut previous, mut is_ascending) = (f64::NEG_INFINITY, true);
    array.series[0].each(|x| {
        is_ascending &= x > previous;
        previous = x;
    })?;
    Ok(is_ascending)
}

/// Assigns each array to a set; returns names and lengths of arrays without one.
fn assign_to_axes(
    tree: &Tree,
    arrays: SortedArrays,
    spacings: &[Spacing],
    is_alone: &HashMap<Path, bool>,
) -> (Vec<RecordingSet>, Vec<(String, usize)>) {
    let (mut by_axis, mut timed) = (NearestByName::default(), NearestByName::default());
    let mut sets: Vec<RecordingSet> = Vec::new();
    let columns_of = |array: Array| {
        let is_alone = is_alone.get(&array.path).copied().unwrap_or_default();
        columns(tree, array, is_alone)
    };
    for (array, over) in arrays.axes {
        let (length, scope) = (array.length(), array.path.scope().to_vec());
        by_axis.insert((length, over), &scope, sets.len());
        timed.insert((), &scope, sets.len());
        let axis = columns_of(array).pop().map_or(SampleAxis::Unknown, |axis| {
            SampleAxis::Array(Box::new(axis), over)
        });
        sets.push(RecordingSet {
            axis,
            length,
            scope,
            columns: Vec::new(),
        });
    }
    let axis_count = sets.len();
    // A number in the struct of a time array gives the rate of that array only.
    let mut free = NearestByName::default();
    for (k, spacing) in spacings
        .iter()
        .enumerate()
        .filter(|(_, spacing)| timed.at_scope((), &spacing.scope).is_none())
    {
        free.insert((), &spacing.scope, k);
    }
    let mut uniform_sets = HashMap::<(Option<usize>, usize), usize>::new();
    for array in arrays.channels {
        let (length, scope, path) = (
            array.length(),
            array.path.scope().to_vec(),
            array.path.0.clone(),
        );
        let order = if array.imaginary.is_some() {
            [Over::Frequency, Over::Time]
        } else {
            [Over::Time, Over::Frequency]
        };
        let at = by_axis
            .nearest(&order.map(|over| (length, over)), &scope)
            .unwrap_or_else(|| {
                // A number may be an attribute of the array.
                let spacing = free.nearest(&[()], &path);
                *uniform_sets.entry((spacing, length)).or_insert_with(|| {
                    let axis = spacing.map_or(SampleAxis::Unknown, |k| {
                        SampleAxis::Even(spacings[k].clone())
                    });
                    sets.push(RecordingSet {
                        axis,
                        length,
                        scope,
                        columns: Vec::new(),
                    });
                    sets.len() - 1
                })
            });
        sets[at].columns.extend(columns_of(array));
    }
    let excluded = keep_longest(&mut sets, axis_count);
    (sets, excluded)
}

/// Keeps the longest arrays of each rate, and of those without a rate if nothing else is known;
/// returns the others.
fn keep_longest(sets: &mut Vec<RecordingSet>, axis_count: usize) -> Vec<(String, usize)> {
    let key = |set: &RecordingSet| {
        if let SampleAxis::Even(spacing) = &set.axis {
            Some(spacing.scope.clone())
        } else {
            None
        }
    };
    let mut max_lengths: HashMap<Option<Vec<String>>, usize> = HashMap::new();
    for set in &sets[axis_count..] {
        let length = max_lengths.entry(key(set)).or_default();
        *length = set.length.max(*length);
    }
    let known = sets[..axis_count].iter().any(|set| !set.columns.is_empty())
        || max_lengths.keys().any(Option::is_some);
    let mut excluded = Vec::new();
    let mut number = 0;
    sets.retain(|set| {
        number += 1;
        let set_key = key(set);
        let is_retained = number <= axis_count
            || (set_key.is_some() || !known && axis_count == 0)
                && max_lengths.get(&set_key) == Some(&set.length);
        if !is_retained {
            excluded.extend(
                set.columns
                    .iter()
                    .map(|column| (column.name.clone(), set.length)),
            );
        }
        is_retained
    });
    excluded
}

/// Lookup by enclosing names: finds the item of a kind that shares the most names with an array,
/// counted from the outermost.
struct NearestByName<K>(HashMap<(K, Vec<String>), usize>);

impl<K> Default for NearestByName<K> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<K: Copy + Eq + Hash> NearestByName<K> {
    /// Stores the first item for each list of outermost names.
    fn insert(&mut self, kind: K, scope: &[String], number: usize) {
        for depth in 0..=scope.len() {
            self.0
                .entry((kind, scope[..depth].to_vec()))
                .or_insert(number);
        }
    }

    /// Returns the first item inside these names.
    fn at_scope(&self, kind: K, scope: &[String]) -> Option<usize> {
        self.0.get(&(kind, scope.to_vec())).copied()
    }

    /// Returns the nearest item; among equally near kinds, the first.
    fn nearest(&self, kinds: &[K], scope: &[String]) -> Option<usize> {
        (0..=scope.len()).rev().find_map(|depth| {
            kinds
                .iter()
                .find_map(|kind| self.at_scope(*kind, &scope[..depth]))
        })
    }
}

fn columns(tree: &Tree, array: Array, is_alone: bool) -> Vec<RawColumn> {
    let heads = heads(tree, &array, is_alone);
    let mut imaginary = array.imaginary.map(|imaginary| imaginary.into_iter());
    let column = |((name, unit), values): ((String, String), _)| RawColumn {
        imaginary: imaginary.as_mut().and_then(Iterator::next),
        ..RawColumn::new(&name, &unit, values)
    };
    heads.into_iter().zip(array.series).map(column).collect()
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
