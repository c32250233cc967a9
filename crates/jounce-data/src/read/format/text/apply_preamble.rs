//! Applies the preamble of a text to its columns.

use std::io;

use super::TextLayout;
use crate::read::assemble::rise::{is_counter, uniform_step};
use crate::read::assemble::time::is_time_column;
use crate::read::column::raw::{Rate, RawColumn};
use crate::recording::Series as _;

/// Gives columns the names and units of the preamble. If no column is named as time, selects one
/// with the step of the preamble.
pub(super) fn apply_preamble(columns: &mut [RawColumn], layout: &TextLayout) -> io::Result<()> {
    let preamble = &layout.preamble;
    let has_no_name = |k: usize| layout.heads.get(k).is_some_and(|head| head.has_no_name);
    let mut time =
        (0..columns.len()).find(|k| columns[*k].left_out.is_none() && is_time_column(&columns[*k]));
    if let (None, Some(rate)) = (time, &preamble.rate) {
        let first = (0..columns.len())
            .find(|k| columns[*k].left_out.is_none() && columns[*k].values.count() > 0);
        if let Some(k) = first.filter(|k| columns[*k].unit.is_empty()) {
            let is_time = has_step(&columns[k], rate)?;
            if is_time {
                columns[k].unit = "s".to_owned();
            }
            if is_time && has_no_name(k) {
                columns[k].name = "Time".to_owned();
            }
            time = is_time.then_some(k);
        }
    }
    if let Some((k, unit)) = time
        .zip(preamble.time_unit.as_ref())
        .filter(|(k, _)| columns[*k].unit.is_empty())
    {
        columns[k].unit.clone_from(unit);
    }
    let mut channels = Vec::new();
    for (k, column) in columns.iter().enumerate() {
        if Some(k) != time && column.left_out.is_none() && !is_counter(column)? {
            channels.push(k);
        }
    }
    for (index, k) in channels.iter().enumerate() {
        let unit = if preamble.units.len() == channels.len() {
            preamble.units.get(index)
        } else {
            preamble.units.first()
        };
        if let Some(unit) = unit.filter(|_| {
            columns[*k].unit.is_empty() && [1, channels.len()].contains(&preamble.units.len())
        }) {
            columns[*k].unit.clone_from(unit);
        }
        if let Some(name) = preamble
            .names
            .get(index)
            .filter(|_| preamble.names.len() == channels.len())
        {
            columns[*k].name.clone_from(name);
        }
    }
    Ok(())
}

fn has_step(column: &RawColumn, rate: &Rate) -> io::Result<bool> {
    Ok(uniform_step(&column.values)?.is_some_and(|step| !rate.differs_from(1.0 / step)))
}
