//! Cuts a part of a recording without holding its numbers in memory.

use std::io;

use super::numbers::ColumnNumbers;
use super::samples::SampleStore;
use super::summary::{ChannelSummary, RecordingSummary, SamplePlaces};
use crate::recording::{Issue, IssueKind, IssuePlace, Over, PIECE, Series, inspected, sizes_with};

/// Tolerance at the ends of a part, relative to the step: roundoff of numbers such as `0.1`.
const END_ROUNDOFF: f64 = 1e-6;

impl RecordingSummary {
    /// Selects channels, counted from 0, between two positions (s or Hz), both included; `None` if
    /// the interval contains no sample. Issues are those of the complete recording, with its sample
    /// numbers.
    ///
    /// # Errors
    /// The scratch file cannot be read or written.
    pub fn part(&self, (from, to): (f64, f64), channels: &[usize]) -> io::Result<Option<Self>> {
        let slack = END_ROUNDOFF / self.rate();
        let (mut first, mut count, mut number) = (0, 0, 0);
        self.places.each(|place| {
            first += usize::from(place < from - slack);
            count += usize::from((from - slack..=to + slack).contains(&place));
            number += 1;
        })?;
        if count == 0 {
            return Ok(None);
        }
        let store = SampleStore::scratch();
        let cut = |numbers: &ColumnNumbers| cut(numbers, first, count, &store);
        let places = match &self.places {
            SamplePlaces::Even { start, step, .. } => SamplePlaces::Even {
                start: start + first as f64 * step,
                step: *step,
                count,
            },
            SamplePlaces::Stamped { stamps, rate } => SamplePlaces::Stamped {
                stamps: cut(stamps)?,
                rate: *rate,
            },
        };
        let channel = |channel: &ChannelSummary| -> io::Result<ChannelSummary> {
            let (values, imaginary) = (
                cut(&channel.values)?,
                channel.imaginary.as_ref().map(cut).transpose()?,
            );
            Ok(ChannelSummary {
                name: channel.name.clone(),
                quantity: channel.quantity,
                unit: channel.unit.clone(),
                place: channel.place.clone(),
                reference: channel.reference.clone(),
                direction: channel.direction.clone(),
                sizes: sizes_with(inspected(&values, false)?.1, &values, imaginary.as_ref())?,
                values,
                imaginary,
            })
        };
        let channels = channels
            .iter()
            .filter_map(|k| self.channels.get(*k))
            .map(channel)
            .collect::<io::Result<Vec<_>>>()?;
        let left_out = |name: &String| {
            self.channels.iter().any(|own| own.name == *name)
                && channels.iter().all(|own| own.name != *name)
        };
        let is_kept = |finding: &&Issue| !finding.channel.as_ref().is_some_and(left_out);
        let mut findings: Vec<Issue> = self.findings.iter().filter(is_kept).cloned().collect();
        let unit = if self.over == Over::Time { "s" } else { "Hz" };
        let about = format!(
            "{count} of {number} samples, from {from} {unit} to {to} {unit}; the other issues are \
            those of the complete recording"
        );
        if count < number {
            findings.push(Issue::new(
                IssueKind::Cut,
                count,
                Some(IssuePlace::Sample(first)),
                about,
            ));
        }
        Ok(Some(Self {
            name: self.name.clone(),
            over: self.over,
            places,
            channels,
            findings,
        }))
    }
}

/// Copies `count` numbers from an index to a store.
fn cut(
    numbers: &ColumnNumbers,
    first: usize,
    count: usize,
    store: &SampleStore,
) -> io::Result<ColumnNumbers> {
    let mut kept = store.column();
    let end = first + count;
    for index in first / PIECE..end.div_ceil(PIECE) {
        let piece = numbers.piece(index)?;
        let begin = index * PIECE;
        let inside = first.saturating_sub(begin)..(end - begin).min(piece.len());
        piece[inside].iter().try_for_each(|x| kept.push(*x))?;
    }
    Ok(kept)
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
            findings: Vec::new(),
        }
        .into()
    }

    /// Covers several pieces, with uniform and stamped positions; both ends are included despite
    /// roundoff.
    #[test]
    fn a_part_holds_the_samples_between_its_ends() {
        let count = 3 * PIECE + 11;
        let even = ramp(Grid::Even {
            start: 0.5,
            step: 0.1,
            count,
        });
        let stamped = ramp(Grid::Stamped(
            (0..count).map(|k| 0.5 + 0.1 * k as f64).collect(),
        ));
        for whole in [even, stamped] {
            for (first, last) in [(0, 0), (3, 7), (PIECE - 1, PIECE), (PIECE, 3 * PIECE + 10)] {
                let place = |k: usize| 0.1 * (k as f64 + 5.0);
                let part = whole
                    .part((place(first), place(last)), &[0])
                    .unwrap()
                    .unwrap()
                    .into_recording()
                    .unwrap();
                assert!(
                    part.channels[0]
                        .values
                        .iter()
                        .copied()
                        .eq((first..=last).map(|k| k as f64)),
                    "{first} to {last}"
                );
                assert!((part.grid.at(0) - place(first)).abs() < 1e-9 && part.findings.len() == 1);
            }
            assert!(
                whole.part((0.51, 0.59), &[0]).unwrap().is_none()
                    && whole.part((-3.0, 0.4), &[0]).unwrap().is_none()
            );
        }
    }
}
