//! Selection of a channel by name, number or quantity.

use super::{Channel, Issue, IssueKind, NoChannel, Quantity, Recording};

/// Error of selecting a channel.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChannelError {
    /// The channel does not exist.
    #[error(transparent)]
    Missing(#[from] NoChannel),
    /// No channel has the quantity, and there is more than one.
    #[error("name the channel; {recording} has {}", channels.join(", "))]
    Unnamed {
        /// The recording.
        recording: String,
        /// Channels of the recording.
        channels: Vec<String>,
    },
    /// The channel has another quantity.
    #[error(
        "channel {channel:?} of {recording} is in {unit}{}, but a channel in {wanted} is needed; \
        write unit = \"{wanted}\" under [channel.{channel:?}] in FILE.channels.toml",
        if *is_known { "" } else { ", an unknown unit" }
    )]
    Unit {
        /// Channel name.
        channel: String,
        /// Channel unit.
        unit: String,
        /// False for a unit that is not known.
        is_known: bool,
        /// SI unit of the quantity.
        wanted: &'static str,
        /// The recording.
        recording: String,
    },
    /// The channel holds counts of a converter, whose unit cannot be assumed.
    #[error(
        "channel {channel:?} of {recording} holds whole numbers without a unit, up to {peak}, as a \
        converter gives them; write unit = \"{wanted}\" and scale = ... under \
        [channel.{channel:?}] in FILE.channels.toml"
    )]
    Counts {
        /// Channel name.
        channel: String,
        /// Largest magnitude.
        peak: f64,
        /// SI unit of the quantity.
        wanted: &'static str,
        /// The recording.
        recording: String,
    },
}

/// Properties by which a channel is selected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelHead<'a> {
    /// Channel name.
    pub name: &'a str,
    /// Measured quantity.
    pub quantity: Quantity,
    /// Channel unit.
    pub unit: &'a str,
}

impl ChannelHead<'_> {
    /// True where the channel has a unit, known or not.
    pub fn has_unit(&self) -> bool {
        !matches!(self.unit.trim(), "" | "NONE")
    }

    /// True where the channel measures a quantity, or may do so because it has no unit.
    pub fn may_be(&self, quantity: Quantity) -> bool {
        self.quantity == quantity || self.quantity == Quantity::Unknown && !self.has_unit()
    }

    /// Issue to report if a channel without a unit is used for a quantity.
    pub fn assumed_unit_issue(&self, quantity: Quantity) -> Option<Issue> {
        let message = || format!("no unit is given; {} is assumed", quantity.si_unit());
        let has_no_unit = self.quantity == Quantity::Unknown && !self.has_unit();
        has_no_unit.then(|| Issue::new(IssueKind::Assumed, 1, None, message()).of(self.name))
    }
}

/// Returns the index of a channel, from its name or its number from 1.
///
/// # Errors
/// No such channel; the error lists the existing ones.
pub fn find_channel(
    recording: &str,
    heads: &[ChannelHead<'_>],
    requested: &str,
) -> Result<usize, NoChannel> {
    let by_number = || {
        requested
            .parse::<usize>()
            .ok()
            .and_then(|number| number.checked_sub(1))
            .filter(|k| *k < heads.len())
    };
    heads
        .iter()
        .position(|head| head.name == requested)
        .or_else(by_number)
        .ok_or_else(|| NoChannel {
            wanted: requested.to_owned(),
            recording: recording.to_owned(),
            channels: names(heads),
        })
}

/// Returns the index of a channel by name or number; without one, the first channel of a quantity,
/// or the only channel. A channel without a unit is accepted for any quantity, one with another
/// unit is refused.
///
/// # Errors
/// [`ChannelError`].
pub fn choose_channel(
    recording: &str,
    heads: &[ChannelHead<'_>],
    requested: Option<&str>,
    quantity: Quantity,
) -> Result<usize, ChannelError> {
    let of_quantity = || heads.iter().position(|head| head.quantity == quantity);
    let single_channel = || (heads.len() == 1).then_some(0);
    let unnamed = || ChannelError::Unnamed {
        recording: recording.to_owned(),
        channels: names(heads),
    };
    let number = match requested {
        Some(requested) => find_channel(recording, heads, requested)?,
        None => of_quantity().or_else(single_channel).ok_or_else(unnamed)?,
    };
    let head = heads[number];
    if head.may_be(quantity) {
        return Ok(number);
    }
    Err(ChannelError::Unit {
        channel: head.name.to_owned(),
        unit: head.unit.to_owned(),
        is_known: head.quantity != Quantity::Unknown,
        wanted: quantity.si_unit(),
        recording: recording.to_owned(),
    })
}

fn names(heads: &[ChannelHead<'_>]) -> Vec<String> {
    heads.iter().map(|head| head.name.to_owned()).collect()
}

impl Recording {
    /// Selects a channel by name or number; without one, the first channel of a quantity, or the
    /// only channel. A channel without a unit is accepted for any quantity, one with another unit
    /// is refused.
    ///
    /// # Errors
    /// [`ChannelError`].
    pub fn choose(
        &self,
        requested: Option<&str>,
        quantity: Quantity,
    ) -> Result<&Channel, ChannelError> {
        Ok(&self.channels[choose_channel(&self.name, &self.heads(), requested, quantity)?])
    }

    /// Properties by which each channel is selected.
    pub fn heads(&self) -> Vec<ChannelHead<'_>> {
        self.channels.iter().map(Channel::head).collect()
    }

    /// Returns the error for a request that does not name its channel.
    pub fn unnamed(&self) -> ChannelError {
        ChannelError::Unnamed {
            recording: self.name.clone(),
            channels: names(&self.heads()),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Grid, Over};

    fn recording(channels: &[(&str, Quantity, &str)]) -> Recording {
        let channels = channels
            .iter()
            .map(|(name, quantity, unit)| Channel::new(name, *quantity, unit, vec![0.0; 4]))
            .collect();
        let grid = Grid::even(0.0, 1.0, 4).unwrap();
        Recording {
            name: "r".into(),
            over: Over::Time,
            grid,
            channels,
            issues: Vec::new(),
        }
    }

    #[test]
    fn channel_is_chosen_by_name_by_quantity_or_if_it_is_the_only_one() {
        let two = recording(&[
            ("a", Quantity::Acceleration, "m/s^2"),
            ("v", Quantity::Voltage, "V"),
        ]);
        assert_eq!(two.choose(None, Quantity::Voltage).unwrap().name, "v");
        assert_eq!(
            two.choose(Some("1"), Quantity::Acceleration).unwrap().name,
            "a"
        );
        assert!(matches!(
            two.choose(Some("a"), Quantity::Voltage),
            Err(ChannelError::Unit { .. })
        ));
        assert!(matches!(
            two.choose(Some("b"), Quantity::Voltage),
            Err(ChannelError::Missing(_))
        ));
        let message = two.choose(None, Quantity::Force).unwrap_err().to_string();
        assert_eq!(message, "name the channel; r has a, v");
        let without_unit = recording(&[("x", Quantity::Unknown, "")]);
        let channel = without_unit.choose(None, Quantity::Force).unwrap();
        assert_eq!(
            channel
                .head()
                .assumed_unit_issue(Quantity::Force)
                .unwrap()
                .to_string(),
            "x: no unit is given; N is assumed"
        );
        let unknown_unit = recording(&[("x", Quantity::Unknown, "furlong")]);
        assert!(matches!(
            unknown_unit.choose(None, Quantity::Force),
            Err(ChannelError::Unit { .. })
        ));
        assert_eq!(
            two.channels[1].head().assumed_unit_issue(Quantity::Voltage),
            None
        );
    }
}
