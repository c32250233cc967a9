//! Cuts a part of a recording without holding its numbers in memory.

use std::io;

use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::samples::SampleStore;
use crate::read::summary::{ChannelSummary, RecordingSummary, SamplePlaces};
use crate::recording::{
    Issue, IssueKind, IssuePlace, Over, PIECE, Series, inspect_samples, sizes_with,
};

/// Tolerance at the ends of a part, relative to the step: roundoff of numbers such as `0.1`.
const END_ROUNDOFF: f64 = 1e-6;

impl RecordingSummary {
    /// Selects channels, counted from 0, between two positions (s or Hz), both included; `None` if
    /// the interval contains no sample. Issues are those of the complete recording, with its sample
    /// numbers.
    ///
    /// # Errors
    /// The scratch file cannot be read or written.
    pub fn slice(&self, (from, to): (f64, f64), channels: &[usize]) -> io::Result<Option<Self>> {
        let tolerance = END_ROUNDOFF / self.rate();
        let (mut first, mut count, mut number) = (0, 0, 0);
        self.places.each(|position| {
            first += usize::from(position < from - tolerance);
            count += usize::from((from - tolerance..=to + tolerance).contains(&position));
            number += 1;
        })?;
        if count == 0 {
            return Ok(None);
        }
        let store = SampleStore::scratch();
        let range = |numbers: &ColumnNumbers| copy_range(numbers, first, count, &store);
        let places = match &self.places {
            SamplePlaces::Even { start, step, .. } => SamplePlaces::Even {
                start: start + first as f64 * step,
                step: *step,
                count,
            },
            SamplePlaces::Stamped { stamps, rate } => SamplePlaces::Stamped {
                stamps: range(stamps)?,
                rate: *rate,
            },
        };
        let channels = channels
            .iter()
            .filter_map(|k| self.channels.get(*k))
            .map(|channel| slice_channel(channel, &range))
            .collect::<io::Result<Vec<_>>>()?;
        let mut issues = self.issues_of(&channels);
        let unit = if self.over == Over::Time { "s" } else { "Hz" };
        let message = format!(
            "{count} of {number} samples, from {from} {unit} to {to} {unit}; the other issues are \
            those of the complete recording"
        );
        if count < number {
            issues.push(Issue::new(
                IssueKind::Cut,
                count,
                Some(IssuePlace::Sample(first)),
                message,
            ));
        }
        Ok(Some(Self {
            name: self.name.clone(),
            over: self.over,
            places,
            channels,
            issues,
        }))
    }

    /// Issues that do not concern a channel that was left out.
    fn issues_of(&self, channels: &[ChannelSummary]) -> Vec<Issue> {
        let left_out = |name: &String| {
            self.channels
                .iter()
                .any(|candidate| candidate.name == *name)
                && channels.iter().all(|candidate| candidate.name != *name)
        };
        let is_relevant = |issue: &&Issue| !issue.channel.as_ref().is_some_and(left_out);
        self.issues.iter().filter(is_relevant).cloned().collect()
    }
}

/// Part of a channel; `range` cuts its numbers.
fn slice_channel(
    channel: &ChannelSummary,
    range: &impl Fn(&ColumnNumbers) -> io::Result<ColumnNumbers>,
) -> io::Result<ChannelSummary> {
    let (values, imaginary) = (
        range(&channel.values)?,
        channel.imaginary.as_ref().map(range).transpose()?,
    );
    Ok(ChannelSummary {
        name: channel.name.clone(),
        quantity: channel.quantity,
        unit: channel.unit.clone(),
        place: channel.place.clone(),
        reference: channel.reference.clone(),
        direction: channel.direction.clone(),
        sizes: sizes_with(
            inspect_samples(&values, false)?.1,
            &values,
            imaginary.as_ref(),
        )?,
        values,
        imaginary,
    })
}

/// Copies `count` numbers from an index to a store.
fn copy_range(
    numbers: &ColumnNumbers,
    first: usize,
    count: usize,
    store: &SampleStore,
) -> io::Result<ColumnNumbers> {
    let mut copied = store.column();
    let end = first + count;
    for index in first / PIECE..end.div_ceil(PIECE) {
        let piece = numbers.piece(index)?;
        let piece_start = index * PIECE;
        let range_in_piece =
            first.saturating_sub(piece_start)..(end - piece_start).min(piece.len());
        piece[range_in_piece]
            .iter()
            .try_for_each(|x| copied.push(*x))?;
    }
    Ok(copied)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Channel, Grid, Quantity, Recording};

    fn ramp(grid: Grid) -> RecordingSummary {
        let values = (0..grid.len()).map(|k| k as f64).collect();
        let channel = Channel::new("ramp", Quantity::Voltage, "V", values);
        Recording {
            name: "r".into(),
            over: Over::Time,
            grid,
            channels: vec![channel],
            issues: Vec::new(),
        }
        .into()
    }

    /// Covers several pieces, with uniform and stamped positions; both ends are included despite
    /// roundoff.
    #[test]
    fn slice_contains_the_samples_between_its_ends() {
        let count = 3 * PIECE + 11;
        let even = ramp(Grid::Even {
            start: 0.5,
            step: 0.1,
            count,
        });
        let stamped = ramp(Grid::Stamped(
            (0..count).map(|k| 0.5 + 0.1 * k as f64).collect(),
        ));
        for full in [even, stamped] {
            for (first, last) in [(0, 0), (3, 7), (PIECE - 1, PIECE), (PIECE, 3 * PIECE + 10)] {
                let position = |k: usize| 0.1 * (k as f64 + 5.0);
                let slice = full
                    .slice((position(first), position(last)), &[0])
                    .unwrap()
                    .unwrap()
                    .into_recording()
                    .unwrap();
                assert!(
                    slice.channels[0]
                        .values
                        .iter()
                        .copied()
                        .eq((first..=last).map(|k| k as f64)),
                    "{first} to {last}"
                );
                assert!(
                    (slice.grid.at(0) - position(first)).abs() < 1e-9 && slice.issues.len() == 1
                );
            }
            assert!(
                full.slice((0.51, 0.59), &[0]).unwrap().is_none()
                    && full.slice((-3.0, 0.4), &[0]).unwrap().is_none()
            );
        }
    }
}
