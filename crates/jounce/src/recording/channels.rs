//! Choice of the channels that a computation uses, before their samples are loaded.

use super::Recording;
use crate::error::Error;
use jounce_data::read::{ChannelSummary, RecordingSummary};
use jounce_data::recording::{
    self as data, Channel, ChannelError, ChannelHead, Issue, IssueKind, NoChannel, Over, Quantity,
    choose_channel, find_channel,
};

/// Channels of a recording, whose samples need not be loaded.
#[derive(Debug, Clone)]
pub struct ChannelList {
    recording: String,
    channels: Vec<ListedChannel>,
}

#[derive(Debug, Clone)]
struct ListedChannel {
    name: String,
    quantity: Quantity,
    unit: String,
    is_varying: bool,
}

/// A channel that a computation uses.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenChannel {
    /// Number in the list, from 0.
    pub(super) number: usize,
    /// Issue of a channel without a unit.
    assumed: Option<Issue>,
}

/// Options that choose the channels of a computation.
pub trait UsesChannels {
    /// Returns the channels that the computation uses, in its order.
    ///
    /// # Errors
    /// [`Error::NoChannel`] and [`Error::Channel`] for a channel that does not exist or does not
    /// suit.
    fn channels(&self, list: &ChannelList) -> Result<Vec<ChosenChannel>, Error>;
}

impl ChannelList {
    pub(super) fn of_data(recording: &data::Recording) -> Self {
        let listed = |channel: &Channel| ListedChannel {
            name: channel.name.clone(),
            quantity: channel.quantity,
            unit: channel.unit.clone(),
            is_varying: is_varying(&channel.values),
        };
        Self {
            recording: recording.name.clone(),
            channels: recording.channels.iter().map(listed).collect(),
        }
    }

    pub(super) fn of_summary(recording: &RecordingSummary) -> Self {
        let is_constant = |name: &str| {
            recording.issues.iter().any(|issue| {
                issue.kind == IssueKind::Constant && issue.channel.as_deref() == Some(name)
            })
        };
        let listed = |channel: &ChannelSummary| ListedChannel {
            name: channel.name.clone(),
            quantity: channel.quantity,
            unit: channel.unit.clone(),
            is_varying: channel.sizes.peak > 0.0 && !is_constant(&channel.name),
        };
        Self {
            recording: recording.name.clone(),
            channels: recording.channels.iter().map(listed).collect(),
        }
    }

    /// Returns the number of channels.
    pub(super) fn len(&self) -> usize {
        self.channels.len()
    }

    pub(super) fn names(&self) -> Vec<String> {
        let name = |channel: &ListedChannel| channel.name.clone();
        self.channels.iter().map(name).collect()
    }

    fn heads(&self) -> Vec<ChannelHead<'_>> {
        self.channels.iter().map(ListedChannel::head).collect()
    }

    /// Returns the channel of a name, or of a number from 1, of any quantity.
    pub(crate) fn find(&self, name: &str) -> Result<ChosenChannel, NoChannel> {
        let number = find_channel(&self.recording, &self.heads(), name)?;
        Ok(ChosenChannel {
            number,
            assumed: None,
        })
    }

    /// Returns the channel of a name or number; without one, the only channel or the first of a
    /// quantity. `option` is the name of the option that names the channel.
    pub(crate) fn choose(
        &self,
        option: &'static str,
        name: Option<&str>,
        quantity: Quantity,
    ) -> Result<ChosenChannel, Error> {
        let heads = self.heads();
        let number = choose_channel(&self.recording, &heads, name, quantity);
        let number = number.map_err(|error| match error {
            ChannelError::Missing(error) => Error::NoChannel(error),
            error => Error::Channel { option, error },
        })?;
        Ok(ChosenChannel {
            number,
            assumed: heads[number].assumed_unit_issue(quantity),
        })
    }

    /// Returns the first varying channel of a quantity, else the first varying channel, else the
    /// first channel of the quantity, else the first channel.
    pub(crate) fn first_varying(&self, quantity: Quantity) -> Result<ChosenChannel, Error> {
        let all = || self.channels.iter().enumerate();
        let of_quantity = |(_, channel): &(usize, &ListedChannel)| channel.quantity == quantity;
        let varies = |(_, channel): &(usize, &ListedChannel)| channel.is_varying;
        let found = all()
            .find(|one| of_quantity(one) && varies(one))
            .or_else(|| all().find(varies))
            .or_else(|| all().find(of_quantity))
            .or_else(|| all().next());
        let (number, _) = found.ok_or_else(|| Error::WithoutChannel {
            recording: self.recording.clone(),
        })?;
        Ok(ChosenChannel {
            number,
            assumed: None,
        })
    }
}

impl ListedChannel {
    fn head(&self) -> ChannelHead<'_> {
        ChannelHead {
            name: &self.name,
            quantity: self.quantity,
            unit: &self.unit,
        }
    }
}

impl Recording {
    /// Returns the channels that options choose, at even times and without missing samples, with
    /// their issues, those of the recording, and the corrections made.
    pub(crate) fn load(&self, usage: &impl UsesChannels) -> Result<data::Recording, Error> {
        self.over_time()?;
        let chosen = usage.channels(&self.list)?;
        let channels = chosen
            .iter()
            .map(|one| self.loaded_channel(one.number).cloned())
            .collect::<Result<Vec<_>, _>>()?;
        let left_out: Vec<&str> = (0..self.list.len())
            .filter(|number| chosen.iter().all(|one| one.number != *number))
            .map(|number| self.list.channels[number].name.as_str())
            .collect();
        let of_left_out = |issue: &Issue| {
            let name = issue.channel.as_deref();
            name.is_some_and(|name| left_out.contains(&name))
        };
        let kept = self.issues().iter().filter(|issue| !of_left_out(issue));
        let assumed = chosen.iter().filter_map(|one| one.assumed.as_ref());
        let recording = data::Recording {
            name: self.data.name.clone(),
            over: self.data.over,
            grid: self.data.grid.clone(),
            channels,
            issues: kept.chain(assumed).cloned().collect(),
        };
        Ok(recording.into_even()?)
    }

    /// Returns all channels at even times and without missing samples, with their issues and the
    /// corrections made.
    pub(crate) fn load_all(&self) -> Result<data::Recording, Error> {
        self.over_time()?;
        Ok(self.data.even()?)
    }

    /// Checks that the samples are over time.
    fn over_time(&self) -> Result<(), Error> {
        match self.data.over {
            Over::Time => Ok(()),
            Over::Frequency => Err(Error::NotOverTime {
                recording: self.data.name.clone(),
            }),
        }
    }

    /// Returns a channel of the list.
    pub(super) fn loaded_channel(&self, number: usize) -> Result<&Channel, Error> {
        let index = self.loaded[number].ok_or_else(|| Error::NotLoaded {
            channel: self.list.channels[number].name.clone(),
        })?;
        Ok(&self.data.channels[index])
    }
}

/// True where two samples that are numbers differ.
fn is_varying(values: &[f64]) -> bool {
    let mut finite = values.iter().filter(|value| value.is_finite());
    finite
        .next()
        .is_some_and(|first| finite.any(|value| value != first))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_data::recording::Grid;

    /// Options that choose the first varying voltage.
    struct FirstVoltage;

    impl UsesChannels for FirstVoltage {
        fn channels(&self, list: &ChannelList) -> Result<Vec<ChosenChannel>, Error> {
            Ok(vec![list.first_varying(Quantity::Voltage)?])
        }
    }

    fn recording() -> Recording {
        let channel = |name: &str, quantity: Quantity, last: f64| {
            Channel::new(
                name,
                quantity,
                quantity.si_unit(),
                vec![1.0, f64::NAN, last],
            )
        };
        let issue = |name: &str| Issue::new(IssueKind::Clipping, 1, None, String::new()).of(name);
        data::Recording {
            name: "test".to_owned(),
            over: Over::Time,
            grid: Grid::even(0.0, 1.0, 3).unwrap(),
            channels: vec![
                channel("dead", Quantity::Voltage, 1.0),
                channel("base", Quantity::Acceleration, 2.0),
                channel("patch", Quantity::Voltage, 3.0),
            ],
            issues: vec![issue("dead"), issue("patch")],
        }
        .into()
    }

    #[test]
    fn a_computation_gets_its_channels_with_their_issues() {
        let loaded = recording().load(&FirstVoltage).unwrap();
        assert_eq!(loaded.channels[0].values, [1.0, 2.0, 3.0]);
        let kinds: Vec<_> = loaded.issues.iter().map(|issue| issue.kind).collect();
        assert_eq!(kinds, [IssueKind::Clipping, IssueKind::Bridged]);
        assert_eq!(recording().list.names(), ["dead", "base", "patch"]);
    }

    #[test]
    fn a_channel_that_does_not_suit_is_refused_by_its_option() {
        let recording = recording();
        let error = recording
            .list
            .choose("base", Some("3"), Quantity::Acceleration);
        assert!(matches!(error, Err(Error::Channel { option: "base", .. })));
        assert!(matches!(recording.channel("tip"), Err(Error::NoChannel(_))));
    }
}
