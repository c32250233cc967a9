//! Channels that a computation uses, at even times and without missing samples.

use super::{Recording, UsesChannels};
use crate::error::Error;
use jounce_data::recording::{self as data, Channel, Issue, IssueKind, Over};
use std::borrow::Cow;

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

    /// Returns the samples of one of the channels that options choose which were measured: those of
    /// `even`, its form at even times, without the interpolated ones. Where all had to be resampled,
    /// all count as measured.
    pub(crate) fn measured_values<'a>(
        &'a self,
        usage: &impl UsesChannels,
        even: &'a data::Recording,
        index: usize,
    ) -> Result<Cow<'a, [f64]>, Error> {
        let was = |kind| even.issues.iter().any(|issue| issue.kind == kind);
        if !was(IssueKind::Bridged) || was(IssueKind::Resampled) {
            return Ok(Cow::Borrowed(&even.channels[index].values));
        }
        let chosen = usage.channels(&self.list)?;
        let values = &self.loaded_channel(chosen[index].number)?.values;
        let is_measured = |value: &f64| value.is_finite();
        Ok(values.iter().copied().filter(is_measured).collect())
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{ChannelList, ChosenChannel};
    use jounce_data::recording::{Grid, IssueKind, Quantity};

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
