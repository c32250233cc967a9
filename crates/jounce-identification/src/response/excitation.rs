//! Excitation channel of a structure, and units of responses to it.

use jounce_signal::Samples;

use super::{ChannelChoice, ResponseError};
use jounce_data::recording::{Channel, Quantity, Recording};
use jounce_signal::spectral::{ImpactSettings, SpectralError, is_continuous};

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
    choice: &ChannelChoice,
) -> Result<&'a Channel, ResponseError> {
    let result = match &choice.excitation {
        Excitation::Channel(name) => {
            let result = recording.channel(name)?;
            let (recording, channel, unit) = (
                recording.name.clone(),
                result.name.clone(),
                result.unit.clone(),
            );
            return if INPUTS.contains(&result.quantity) {
                Ok(result)
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
    if result.head().may_be(Quantity::Force) {
        return Ok(result);
    }
    Err(ResponseError::NotForce {
        recording: recording.name.clone(),
        channel: result.name.clone(),
        unit: result.unit.clone(),
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
    let numerator = if output.unit.is_empty() {
        "1"
    } else {
        &output.unit
    };
    let denominator = quantity(input).si_unit();
    if denominator.contains('/') {
        format!("{numerator}/({denominator})")
    } else {
        format!("{numerator}/{denominator}")
    }
}

/// Settings for an input: hits are detected in forces; other inputs are averaged in blocks.
///
/// # Errors
/// A pulse that is not a force; recordings in which one name has two quantities.
pub(super) fn settings(
    records: &[Recording],
    choice: &ChannelChoice,
    requested: &ImpactSettings,
) -> Result<ImpactSettings, ResponseError> {
    let Some(first) = records.first() else {
        return Ok(*requested);
    };
    let expected = quantity(input(first, choice)?);
    for record in records {
        let result = input(record, choice)?;
        if quantity(result) != expected {
            let (channel, unit) = (result.name.clone(), result.unit.clone());
            return Err(ResponseError::InputUnits {
                channel,
                recordings: [first.name.clone(), record.name.clone()],
                unit,
            });
        }
        let samples = Samples::new(&result.values, record.rate()).map_err(SpectralError::from)?;
        if expected != Quantity::Force && !requested.shaker && !is_continuous(&samples) {
            return Err(ResponseError::Pulse {
                recording: record.name.clone(),
                channel: result.name.clone(),
            });
        }
    }
    Ok(if expected == Quantity::Force {
        *requested
    } else {
        ImpactSettings {
            shaker: true,
            ..*requested
        }
    })
}
