//! Choice of the channels that a computation uses, before their samples are loaded.

use crate::error::Error;
use jounce_data::read::{ChannelSummary, RecordingSummary};
use jounce_data::recording::{
    self as data, Channel, ChannelError, ChannelHead, Issue, IssueKind, NoChannel, Quantity,
    choose_channel, find_channel,
};

/// Channels of a recording, whose samples need not be loaded.
#[derive(Debug, Clone)]
pub struct ChannelList {
    recording: String,
    pub(super) channels: Vec<ListedChannel>,
}

#[derive(Debug, Clone)]
pub(super) struct ListedChannel {
    pub(super) name: String,
    quantity: Quantity,
    unit: String,
    is_varying: bool,
    /// Largest magnitude, where the samples are counts of a converter.
    counts_to: Option<f64>,
}

/// A channel that a computation uses.
#[derive(Debug, Clone, PartialEq)]
pub struct ChosenChannel {
    /// Number in the list, from 0.
    pub(super) number: usize,
    /// Issue of a channel without a unit.
    pub(super) assumed: Option<Issue>,
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
            counts_to: (recording.issues.iter())
                .any(|issue| are_counts(issue, &channel.name))
                .then(|| channel.values.iter().fold(0.0, |peak, x| x.abs().max(peak))),
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
            counts_to: (recording.issues.iter())
                .any(|issue| are_counts(issue, &channel.name))
                .then_some(channel.sizes.peak),
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
    /// quantity, with an issue where there are several. `option` is the name of the option that names
    /// the channel.
    pub(crate) fn choose(
        &self,
        option: &'static str,
        requested: Option<&str>,
        quantity: Quantity,
    ) -> Result<ChosenChannel, Error> {
        let heads = self.heads();
        let number = choose_channel(&self.recording, &heads, requested, quantity);
        let number = number.map_err(|error| match error {
            ChannelError::Missing(error) => Error::NoChannel(error),
            error => Error::Channel { option, error },
        })?;
        let ListedChannel {
            name, counts_to, ..
        } = &self.channels[number];
        if let Some(peak) = *counts_to {
            let error = ChannelError::Counts {
                channel: name.clone(),
                peak,
                wanted: quantity.si_unit(),
                recording: self.recording.clone(),
            };
            return Err(Error::Channel { option, error });
        }
        let of_several = || self.first_of_several(option, number, quantity);
        let of_several = requested.is_none().then(of_several).flatten();
        Ok(ChosenChannel {
            number,
            assumed: heads[number].assumed_unit_issue(quantity).or(of_several),
        })
    }

    /// Returns the issue that a channel is the first of several of its quantity.
    fn first_of_several(&self, option: &str, number: usize, quantity: Quantity) -> Option<Issue> {
        let all = self.channels.iter().filter(|one| one.quantity == quantity);
        let names: Vec<&str> = all.map(|one| one.name.as_str()).collect();
        let text = || {
            format!(
                "it is the first of the {} channels in {}: {}; choose another with `{option}`",
                names.len(),
                quantity.si_unit(),
                names.join(", ")
            )
        };
        let issue = || Issue::new(IssueKind::Assumed, 1, None, text());
        (names.len() > 1).then(|| issue().of(&self.channels[number].name))
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

/// True for the issue that a channel holds counts of a converter.
fn are_counts(issue: &Issue, channel: &str) -> bool {
    issue.kind == IssueKind::RawCounts && issue.channel.as_deref() == Some(channel)
}

/// True where two samples that are numbers differ.
fn is_varying(values: &[f64]) -> bool {
    let mut finite = values.iter().filter(|value| value.is_finite());
    finite
        .next()
        .is_some_and(|first| finite.any(|value| value != first))
}
