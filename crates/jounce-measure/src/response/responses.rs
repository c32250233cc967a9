//! The responses of a structure to the force of a hammer.

use jounce::signal::{Samples, SignalError};
use realfft::num_complex::Complex;

use super::ResponseError;
use crate::recording::{Channel, Finding, Quantity, Recording, Unit};
use crate::spectral::{FrequencyResponse, ImpactHit, ImpactRecord, ImpactSettings, SpectralError, impact};

/// Which channels are what.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chosen {
    /// The force; none for the first channel in newtons.
    pub force: Option<String>,
    /// The responses; empty for all channels but the force.
    pub responses: Vec<String>,
}

/// Response functions over common frequencies, and what they rest on.
#[derive(Debug, Clone, PartialEq)]
pub struct Responses {
    /// Name of each response.
    pub names: Vec<String>,
    /// Unit of each, per newton.
    pub units: Vec<String>,
    /// What each measures.
    pub quantities: Vec<Quantity>,
    /// The response functions.
    pub functions: Vec<FrequencyResponse>,
    /// The hits; none where response functions were given.
    pub hits: Vec<ImpactHit>,
    /// Length of a block, s; none where response functions were given.
    pub block_s: Option<f64>,
    /// Damping that the window adds to every mode, 1/s.
    pub window_decay_per_s: f64,
    /// What is odd about the recordings.
    pub findings: Vec<Finding>,
}

impl Responses {
    /// The responses of a hammer test: recordings over even times, with one or more hits in each, the channels the same in all.
    ///
    /// # Errors
    /// A channel that is not there or no force, nothing beside the force, what [`impact`] refuses.
    pub fn of_hits(records: &[Recording], chosen: &Chosen, settings: &ImpactSettings) -> Result<Self, ResponseError> {
        let first = records.first().ok_or(ResponseError::Nothing)?;
        let hammer = force(first, chosen)?;
        let names: Vec<String> = match &chosen.responses[..] {
            [] => first.channels.iter().map(|channel| channel.name.clone()).filter(|name| *name != hammer.name).collect(),
            wanted => wanted.iter().map(|name| Ok(first.channel(name)?.name.clone())).collect::<Result<_, ResponseError>>()?,
        };
        if names.is_empty() {
            return Err(ResponseError::NoResponse { recording: first.name.clone(), force: hammer.name.clone() });
        }
        let cut = |recording| impact_record(recording, chosen, &names);
        let blocks = records.iter().map(cut).collect::<Result<Vec<_>, _>>()?;
        let answer = impact(&blocks, settings)?;
        let channels = names.iter().map(|name| first.channel(name)).collect::<Result<Vec<_>, _>>()?;
        let unit = |channel: &&Channel| if channel.unit.is_empty() { "1/N".to_owned() } else { format!("{}/N", channel.unit) };
        Ok(Self {
            units: channels.iter().map(unit).collect(),
            quantities: channels.iter().map(|channel| channel.quantity).collect(),
            names,
            functions: answer.responses,
            hits: answer.hits,
            block_s: Some(answer.block_s),
            window_decay_per_s: answer.window_decay_per_s,
            findings: records
                .iter()
                .flat_map(|recording| recording.findings.clone())
                .chain(hammer.head().assumed(Quantity::Force))
                .collect(),
        })
    }

    /// Response functions that were measured before: every complex channel of recordings over frequency. Nothing is known of their
    /// coherence.
    ///
    /// # Errors
    /// No recording, no complex channel, unequal frequencies.
    pub fn given(recordings: &[Recording]) -> Result<Self, ResponseError> {
        let first = recordings.first().ok_or(ResponseError::Nothing)?;
        let frequency_hz = first.grid.places();
        let mut found = Self {
            names: Vec::new(),
            units: Vec::new(),
            quantities: Vec::new(),
            functions: Vec::new(),
            hits: Vec::new(),
            block_s: None,
            window_decay_per_s: 0.0,
            findings: recordings.iter().flat_map(|recording| recording.findings.clone()).collect(),
        };
        for recording in recordings {
            if recording.grid.places() != frequency_hz {
                return Err(ResponseError::Frequencies { first: first.name.clone(), other: recording.name.clone() });
            }
            for channel in &recording.channels {
                let Some(imaginary) = &channel.imaginary else { continue };
                let value = channel.values.iter().zip(imaginary).map(|(re, im)| Complex::new(*re, *im)).collect();
                let coherence = vec![1.0; frequency_hz.len()];
                found.names.push(channel.name.clone());
                found.units.push(channel.unit.clone());
                found.quantities.push(Unit::responds(&channel.unit).unwrap_or(channel.quantity));
                found.functions.push(FrequencyResponse { frequency_hz: frequency_hz.clone(), value, coherence, blocks: 1 });
            }
        }
        if found.names.is_empty() {
            return Err(ResponseError::NotComplex { recording: first.name.clone() });
        }
        Ok(found)
    }
}

fn force<'a>(recording: &'a Recording, chosen: &Chosen) -> Result<&'a Channel, ResponseError> {
    let named = chosen.force.as_ref().map(|name| recording.channel(name)).transpose()?;
    let first = || recording.channels.iter().find(|channel| channel.quantity == Quantity::Force);
    let Some(found) = named.or_else(first) else {
        let channels = recording.channels.iter().map(|channel| channel.name.clone()).collect();
        return Err(ResponseError::NoForce { recording: recording.name.clone(), channels });
    };
    // A channel that tells no unit may be the force; one that tells another is not.
    if found.head().may_be(Quantity::Force) {
        return Ok(found);
    }
    Err(ResponseError::NotForce { recording: recording.name.clone(), channel: found.name.clone(), unit: found.unit.clone() })
}

fn impact_record<'a>(recording: &'a Recording, chosen: &Chosen, names: &[String]) -> Result<ImpactRecord<'a>, ResponseError> {
    let told = |fault: SignalError| ResponseError::Spectral(SpectralError::Signal(fault));
    let samples = |channel: &'a Channel| Samples::new(&channel.values, recording.rate()).map_err(told);
    let responses = names.iter().map(|name| samples(recording.channel(name)?)).collect::<Result<_, _>>()?;
    Ok(ImpactRecord { force: samples(force(recording, chosen)?)?, responses })
}
