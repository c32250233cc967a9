//! Separates the arrays of times or frequencies from those of channels.

use std::collections::HashMap;
use std::io;

use super::{Array, Path};
use crate::read::heading::axis::{is_frequency, is_time};
use crate::read::heading::name::split;
use crate::recording::{Over, Series as _};

/// True for each array that is the only data array in its struct. Texts of that struct then apply
/// to it.
pub(super) fn is_only_in_scope(arrays: &[Array]) -> io::Result<HashMap<Path, bool>> {
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
pub(super) struct SortedArrays {
    pub axes: Vec<(Array, Over)>,
    pub channels: Vec<Array>,
}

impl SortedArrays {
    pub(super) fn new(arrays: Vec<Array>) -> io::Result<Self> {
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
