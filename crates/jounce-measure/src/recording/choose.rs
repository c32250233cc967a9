//! The channel that a question is about.

use super::{Channel, NoChannel, Quantity, Recording};

/// A channel that cannot be chosen.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ChannelError {
    /// No such channel.
    #[error(transparent)]
    Missing(#[from] NoChannel),
    /// None of the quantity, and more than one to choose from.
    #[error("name the channel; {recording} has {}", channels.join(", "))]
    Unnamed {
        /// The recording.
        recording: String,
        /// Its channels.
        channels: Vec<String>,
    },
    /// Another quantity.
    #[error(
        "channel {channel} is in {unit}, which is not the unit wanted here; choose another one, or correct its unit in the notes beside {recording}"
    )]
    Unit {
        /// The channel.
        channel: String,
        /// Its unit.
        unit: String,
        /// The recording.
        recording: String,
    },
}

impl Recording {
    /// The channel of a name or number; without one the first of a quantity, or the only channel. A channel that tells no unit may be what it
    /// is asked for; one that tells another is not.
    ///
    /// # Errors
    /// [`ChannelError`].
    pub fn choose(&self, wanted: Option<&str>, quantity: Quantity) -> Result<&Channel, ChannelError> {
        let of_quantity = || self.channels.iter().find(|channel| channel.quantity == quantity);
        let only = || self.channels.first().filter(|_| self.channels.len() == 1);
        let channel = match wanted {
            Some(wanted) => self.channel(wanted)?,
            None => of_quantity().or_else(only).ok_or_else(|| self.unnamed())?,
        };
        if channel.quantity == quantity || channel.quantity == Quantity::Unknown {
            return Ok(channel);
        }
        let (channel, unit) = (channel.name.clone(), channel.unit.clone());
        Err(ChannelError::Unit { channel, unit, recording: self.name.clone() })
    }

    /// The error of a question that does not name its channel.
    pub fn unnamed(&self) -> ChannelError {
        let channels = self.channels.iter().map(|channel| channel.name.clone()).collect();
        ChannelError::Unnamed { recording: self.name.clone(), channels }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Grid, Over};

    fn recording(channels: &[(&str, Quantity, &str)]) -> Recording {
        let channels = channels.iter().map(|(name, quantity, unit)| Channel::new(name, *quantity, unit, vec![0.0; 4])).collect();
        let grid = Grid::even(0.0, 1.0, 4).unwrap();
        Recording { name: "r".into(), over: Over::Time, grid, channels, findings: Vec::new() }
    }

    #[test]
    fn a_channel_is_chosen_by_name_quantity_or_because_it_is_alone() {
        let two = recording(&[("a", Quantity::Acceleration, "m/s^2"), ("v", Quantity::Voltage, "V")]);
        assert_eq!(two.choose(None, Quantity::Voltage).unwrap().name, "v");
        assert_eq!(two.choose(Some("1"), Quantity::Acceleration).unwrap().name, "a");
        assert!(matches!(two.choose(Some("a"), Quantity::Voltage), Err(ChannelError::Unit { .. })));
        assert!(matches!(two.choose(Some("b"), Quantity::Voltage), Err(ChannelError::Missing(_))));
        let told = two.choose(None, Quantity::Force).unwrap_err().to_string();
        assert_eq!(told, "name the channel; r has a, v");
        assert_eq!(recording(&[("x", Quantity::Unknown, "")]).choose(None, Quantity::Force).unwrap().name, "x");
    }
}
