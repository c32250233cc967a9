//! One-line verdict on a recording and the applicable commands.

use crate::read::{ChannelSummary, RecordingSummary, SamplePlaces};
use crate::recording::{IssueKind, Over, Quantity, Series as _};

impl RecordingSummary {
    /// Returns one line: the contents of the recording and the commands that accept it, or what its
    /// notes must specify first.
    pub fn verdict(&self) -> String {
        let live_channels: Vec<&ChannelSummary> = self
            .channels
            .iter()
            .filter(|channel| !self.is_dead(channel))
            .collect();
        let content = content(&live_channels);
        let next_commands = self.next_commands(&live_channels);
        let spacing = if matches!(self.places, SamplePlaces::Even { .. }) {
            "even"
        } else {
            "uneven, resampled where used"
        };
        let unit = if self.over == Over::Time {
            "Hz"
        } else {
            "lines per Hz"
        };
        format!(
            "{content}; {} samples, {:.6} {unit}, {spacing}; next: {next_commands}",
            self.places.count(),
            self.rate()
        )
    }

    /// Commands that accept the recording, or what its notes must specify first.
    fn next_commands(&self, live_channels: &[&ChannelSummary]) -> &'static str {
        let has = |quantity: Quantity| {
            live_channels
                .iter()
                .any(|channel| channel.quantity == quantity)
        };
        let motion =
            has(Quantity::Acceleration) || has(Quantity::Velocity) || has(Quantity::Displacement);
        match self.over {
            _ if live_channels.is_empty() => "nothing can be computed from it",
            _ if live_channels
                .iter()
                .all(|channel| channel.quantity == Quantity::Unknown) =>
            {
                "spectra; give units in the notes of the file for power, frf, modes and contact"
            }
            Over::Frequency if has(Quantity::Response) => "modes --measured",
            Over::Frequency => {
                "spectra over frequency: modes --output-only for an amplitude spectrum"
            }
            Over::Time if has(Quantity::Force) && (motion || has(Quantity::Voltage)) => {
                "frf and modes --measured, contact, spectra"
            }
            Over::Time if has(Quantity::Force) => "contact, spectra",
            Over::Time if has(Quantity::Voltage) && motion => "power, segments, spectra; fit",
            Over::Time if has(Quantity::Voltage) => "power --resistance, segments, spectra",
            Over::Time if motion => {
                "spectra, modes --output-only or --free-decay; rig --base as the motion of a base"
            }
            Over::Time => "spectra",
        }
    }

    /// True for a channel without a signal.
    fn is_dead(&self, channel: &ChannelSummary) -> bool {
        let is_dead_kind =
            |kind: IssueKind| matches!(kind, IssueKind::Constant | IssueKind::EqualsTime);
        let number = channel.sizes.peak == 0.0;
        number
            || self.issues.iter().any(|issue| {
                is_dead_kind(issue.kind) && issue.channel.as_ref() == Some(&channel.name)
            })
    }
}

/// Number of channels of each quantity.
fn content(live_channels: &[&ChannelSummary]) -> String {
    let count = |quantity: Quantity| {
        live_channels
            .iter()
            .filter(|channel| channel.quantity == quantity)
            .count()
    };
    let quantities = [
        (Quantity::Voltage, "voltage"),
        (Quantity::Acceleration, "acceleration"),
        (Quantity::Velocity, "velocity"),
        (Quantity::Displacement, "displacement"),
        (Quantity::Force, "force"),
        (Quantity::Pressure, "pressure"),
        (Quantity::Response, "response"),
        (Quantity::Unknown, "channel of an unknown unit"),
    ];
    let counts: Vec<String> = quantities
        .iter()
        .map(|(quantity, name)| (count(*quantity), name))
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}"))
        .collect();
    if counts.is_empty() {
        "no live channel".to_owned()
    } else {
        counts.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Channel, Grid, Issue, Recording};

    fn verdict(channels: &[(Quantity, &str)], constant: Option<&str>) -> String {
        let channel = |(quantity, name): &(Quantity, &str)| {
            Channel::new(name, *quantity, quantity.si_unit(), vec![1.0, 2.0, 1.0])
        };
        let grid = Grid::Even {
            start: 0.0,
            step: 0.01,
            count: 3,
        };
        let issues = constant
            .map(|name| Issue::new(IssueKind::Constant, 3, None, String::new()).of(name))
            .into_iter()
            .collect();
        let recording = Recording {
            name: "r".into(),
            over: Over::Time,
            grid,
            channels: channels.iter().map(channel).collect(),
            issues,
        };
        RecordingSummary::from(recording).verdict()
    }

    #[test]
    fn a_verdict_names_what_there_is_and_what_is_next() {
        let run = verdict(
            &[(Quantity::Voltage, "v"), (Quantity::Acceleration, "a")],
            None,
        );
        assert_eq!(
            run,
            "1 voltage, 1 acceleration; 3 samples, 100.000000 Hz, even; next: power, segments, spectra; fit"
        );
        assert!(
            verdict(
                &[(Quantity::Force, "f"), (Quantity::Acceleration, "a")],
                None
            )
            .contains("frf and modes")
        );
        assert!(verdict(&[(Quantity::Unknown, "x")], None).contains("give units"));
        assert!(verdict(&[(Quantity::Voltage, "v")], Some("v")).contains("no live channel"));
    }
}
