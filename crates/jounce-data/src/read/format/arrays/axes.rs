//! Assigns each array to the nearest time or frequency array of equal length.

use std::collections::HashMap;

use super::names::heads;
use super::nearest::NearestByName;
use super::sorted::SortedArrays;
use super::spacing::Spacing;
use super::{Array, Path, Tree};
use crate::read::column::raw::RawColumn;
use crate::recording::Over;

/// Source of the sample positions of a recording.
pub(super) enum SampleAxis {
    /// Positions stored in an array.
    Array(Box<RawColumn>, Over),
    /// Uniform grid given by a scalar.
    Even(Spacing),
    /// No information in the file.
    Unknown,
}

/// Recording under construction.
pub(super) struct RecordingSet {
    pub axis: SampleAxis,
    pub length: usize,
    pub scope: Vec<String>,
    pub columns: Vec<RawColumn>,
}

/// Assigns each array to a set; returns names and lengths of arrays without one.
pub(super) fn assign_to_axes(
    tree: &Tree,
    arrays: SortedArrays,
    spacings: &[Spacing],
    is_alone: &HashMap<Path, bool>,
) -> (Vec<RecordingSet>, Vec<(String, usize)>) {
    let columns_of = |array: Array| {
        let is_alone = is_alone.get(&array.path).copied().unwrap_or_default();
        columns(tree, array, is_alone)
    };
    let (mut sets, by_axis, timed) = axis_sets(arrays.axes, &columns_of);
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

/// One empty set for each array of times or frequencies, and where to find them by their structs: by
/// length and kind, and of any kind.
fn axis_sets(
    axes: Vec<(Array, Over)>,
    columns_of: &impl Fn(Array) -> Vec<RawColumn>,
) -> (
    Vec<RecordingSet>,
    NearestByName<(usize, Over)>,
    NearestByName<()>,
) {
    let (mut by_axis, mut timed) = (NearestByName::default(), NearestByName::default());
    let mut sets = Vec::new();
    for (array, over) in axes {
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
    (sets, by_axis, timed)
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

fn columns(tree: &Tree, array: Array, is_alone: bool) -> Vec<RawColumn> {
    let heads = heads(tree, &array, is_alone);
    let mut imaginary = array.imaginary.map(|imaginary| imaginary.into_iter());
    let column = |((name, unit), values): ((String, String), _)| RawColumn {
        imaginary: imaginary.as_mut().and_then(Iterator::next),
        ..RawColumn::new(&name, &unit, values)
    };
    heads.into_iter().zip(array.series).map(column).collect()
}
