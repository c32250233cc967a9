//! The responses of a structure to the force of a hammer or of a shaker.

use jounce::signal::{Samples, SignalError};
use realfft::num_complex::Complex;

use super::ResponseError;
use crate::recording::{Channel, Finding, FindingKind, Quantity, Recording, Unit};
use crate::spectral::{FrequencyResponse, ImpactHit, ImpactRecord, ImpactSettings, Sight, SpectralError, impact};

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
    /// The hits; none under a shaker, or where response functions were given.
    pub hits: Vec<ImpactHit>,
    /// Length of a block, s; none where response functions were given.
    pub block_s: Option<f64>,
    /// Damping that the window adds to every mode, 1/s.
    pub window_decay_per_s: f64,
    /// What is odd about the recordings.
    pub findings: Vec<Finding>,
}

impl Responses {
    /// The responses of a hammer or shaker test: recordings over even times, with one or more hits in each or a force that goes on, the
    /// channels the same in all. Responses to forces at several places are not averaged.
    ///
    /// # Errors
    /// A channel that is not there or no force, forces at several places, nothing beside the force, what [`impact`] refuses.
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
        let place = common_place(records, chosen)?;
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
                .chain(place)
                .chain(answer.swept.then(|| swept(settings, answer.block_s)))
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
                found.functions.push(FrequencyResponse {
                    frequency_hz: frequency_hz.clone(),
                    value,
                    coherence,
                    blocks: 1,
                    sight: Sight::Whole,
                    without: Vec::new(),
                });
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

/// What is assumed of the place of the force where not every recording of several tells it.
fn common_place(records: &[Recording], chosen: &Chosen) -> Result<Option<Finding>, ResponseError> {
    let told = |record: &Recording| {
        let force = force(record, chosen)?;
        Ok([force.place.as_str(), force.direction.as_str()].join(" ").trim().to_owned())
    };
    let places = records.iter().map(told).collect::<Result<Vec<_>, ResponseError>>()?;
    let mut known: Vec<(&str, &str)> = Vec::new();
    for (place, record) in places.iter().zip(records).filter(|(place, _)| !place.is_empty()) {
        if known.iter().all(|(other, _)| other != place) {
            known.push((place, &record.name));
        }
    }
    if known.len() > 1 {
        let places = known.iter().map(|(place, record)| format!("{place} in {record}")).collect();
        return Err(ResponseError::Places { places });
    }
    let silent = places.iter().filter(|place| place.is_empty()).count();
    let about =
        "recordings do not tell where the force acts; it is taken to act at one place in all, give the place in the notes beside them";
    Ok((silent > 0 && records.len() > 1)
        .then(|| Finding::new(FindingKind::Assumed, silent, None, format!("{silent} of {} {about}", records.len()))))
}

/// What a sweep means for its blocks.
fn swept(settings: &ImpactSettings, block_s: f64) -> Finding {
    let about = match settings.block_s {
        None => format!(
            "the force sweeps: each recording is one block of {block_s:.4} s without a window, and the coherence of a single one tells nothing"
        ),
        Some(_) => format!(
            "the force sweeps, and drives each line in few blocks of {block_s:.4} s: peaks come out low; leave out the length of a block, then each \
             recording is one"
        ),
    };
    Finding::new(FindingKind::Assumed, 1, None, about)
}

fn impact_record<'a>(recording: &'a Recording, chosen: &Chosen, names: &[String]) -> Result<ImpactRecord<'a>, ResponseError> {
    let told = |fault: SignalError| ResponseError::Spectral(SpectralError::Signal(fault));
    let samples = |channel: &'a Channel| Samples::new(&channel.values, recording.rate()).map_err(told);
    let responses = names.iter().map(|name| samples(recording.channel(name)?)).collect::<Result<_, _>>()?;
    Ok(ImpactRecord { force: samples(force(recording, chosen)?)?, responses })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{Grid, Over};

    fn struck(name: &str, place: &str) -> Recording {
        let values: Vec<f64> = (0..1000).map(|k| if (20..30).contains(&k) { 50.0 } else { 0.0 }).collect();
        let force = Channel { place: place.to_owned(), ..Channel::new("force", Quantity::Force, "N", values.clone()) };
        let channels = vec![force, Channel::new("a", Quantity::Acceleration, "m/s^2", values)];
        Recording { name: name.to_owned(), over: Over::Time, grid: Grid::even(0.0, 1e-3, 1000).unwrap(), channels, findings: Vec::new() }
    }

    #[test]
    fn hits_at_several_places_are_not_averaged() {
        let of = |records: &[Recording]| Responses::of_hits(records, &Chosen::default(), &ImpactSettings::default());
        let told = of(&[struck("one", "mid"), struck("two", "end"), struck("three", "mid")]).unwrap_err().to_string();
        assert!(told.contains("mid in one, end in two") && told.contains("one place at a time"), "{told}");
        assert!(of(&[struck("one", "mid"), struck("two", "mid")]).unwrap().findings.is_empty());
        let silent = of(&[struck("one", "mid"), struck("two", "")]).unwrap().findings;
        assert!(silent.len() == 1 && silent[0].kind == FindingKind::Assumed && silent[0].about.starts_with("1 of 2"), "{silent:?}");
        assert!(of(&[struck("one", "")]).unwrap().findings.is_empty());
    }

    /// The place of a force survives the formats that can hold it.
    #[test]
    fn a_place_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        for (ending, place) in [("uff", "mid"), ("uff", "node 7"), ("parquet", "beam.hammer"), ("parquet", "node 7")] {
            let path = folder.path().join(format!("hit.{ending}"));
            crate::write::write(&struck("one", place), &path).unwrap();
            let read = crate::read::file(&path).unwrap().recordings.remove(0);
            assert_eq!(read.channel("force").unwrap().place, place, "{ending}");
        }
    }
}
