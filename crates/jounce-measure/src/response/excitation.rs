//! Excitation channel of a structure, and units of responses to it.

use jounce_core::signal::Samples;

use super::{ChannelChoice, ResponseError};
use crate::spectral::{ImpactSettings, SpectralError, goes_on};
use jounce_data::recording::{Channel, Quantity, Recording};

/// Excitation of the structure.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Excitation {
    /// The first channel in newtons.
    #[default]
    FirstForce,
    /// A channel of this name in newtons, or without a unit.
    Force(String),
    /// A channel of this name with its unit: a force, the motion of the base, a voltage, a
    /// pressure.
    Channel(String),
}

/// Quantities allowed as excitation.
const INPUTS: [Quantity; 6] = [
    Quantity::Force,
    Quantity::Acceleration,
    Quantity::Velocity,
    Quantity::Displacement,
    Quantity::Voltage,
    Quantity::Pressure,
];

/// Returns the excitation channel of a recording.
pub(super) fn input<'a>(
    recording: &'a Recording,
    chosen: &ChannelChoice,
) -> Result<&'a Channel, ResponseError> {
    let found = match &chosen.excitation {
        Excitation::Channel(name) => {
            let found = recording.channel(name)?;
            let (recording, channel, unit) = (
                recording.name.clone(),
                found.name.clone(),
                found.unit.clone(),
            );
            return if INPUTS.contains(&found.quantity) {
                Ok(found)
            } else {
                Err(ResponseError::NotInput {
                    recording,
                    channel,
                    unit,
                })
            };
        }
        Excitation::Force(name) => recording.channel(name)?,
        Excitation::FirstForce => {
            let channels = || {
                recording
                    .channels
                    .iter()
                    .map(|channel| channel.name.clone())
                    .collect()
            };
            let first = recording
                .channels
                .iter()
                .find(|channel| channel.quantity == Quantity::Force);
            first.ok_or_else(|| ResponseError::NoForce {
                recording: recording.name.clone(),
                channels: channels(),
            })?
        }
    };
    // A channel without unit may be the force; one with another unit is not.
    if found.head().may_be(Quantity::Force) {
        return Ok(found);
    }
    Err(ResponseError::NotForce {
        recording: recording.name.clone(),
        channel: found.name.clone(),
        unit: found.unit.clone(),
    })
}

/// Quantity of the channel: a force if it has no unit.
pub(super) fn quantity(input: &Channel) -> Quantity {
    if input.quantity == Quantity::Unknown {
        Quantity::Force
    } else {
        input.quantity
    }
}

/// Unit of a response per input, written as by [`jounce_data::recording::Unit`].
pub(super) fn unit(output: &Channel, input: &Channel) -> String {
    let above = if output.unit.is_empty() {
        "1"
    } else {
        &output.unit
    };
    let below = quantity(input).si_unit();
    if below.contains('/') {
        format!("{above}/({below})")
    } else {
        format!("{above}/{below}")
    }
}

/// Settings for an input: hits are detected in forces; other inputs are averaged in blocks.
///
/// # Errors
/// A pulse that is not a force; recordings in which one name has two quantities.
pub(super) fn settings(
    records: &[Recording],
    chosen: &ChannelChoice,
    asked: &ImpactSettings,
) -> Result<ImpactSettings, ResponseError> {
    let Some(first) = records.first() else {
        return Ok(*asked);
    };
    let due = quantity(input(first, chosen)?);
    for record in records {
        let found = input(record, chosen)?;
        if quantity(found) != due {
            let (channel, unit) = (found.name.clone(), found.unit.clone());
            return Err(ResponseError::InputUnits {
                channel,
                recordings: [first.name.clone(), record.name.clone()],
                unit,
            });
        }
        let samples = Samples::new(&found.values, record.rate()).map_err(SpectralError::from)?;
        if due != Quantity::Force && !asked.shaker && !goes_on(&samples) {
            return Err(ResponseError::Pulse {
                recording: record.name.clone(),
                channel: found.name.clone(),
            });
        }
    }
    Ok(if due == Quantity::Force {
        *asked
    } else {
        ImpactSettings {
            shaker: true,
            ..*asked
        }
    })
}
