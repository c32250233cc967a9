//! Imported response functions.

use realfft::num_complex::Complex;

use super::forces::place;
use super::{MeasuredResponses, ResponseError};
use crate::spectral::{FrequencyResponse, WindowBias};
use jounce_data::recording::{Channel, Issue, IssueKind, Quantity, Recording, Unit};

/// Assignment of functions to outputs and references.
struct FunctionChannels {
    outputs: Vec<String>,
    references: Vec<String>,
    /// Indices of the functions: output `o` to reference `i` is at `o * references + i`.
    order: Vec<usize>,
}

impl MeasuredResponses {
    /// Imports every complex channel of recordings over frequency as a response function. If they
    /// give several references, and there is one function of each output to each, they are assigned
    /// accordingly. Otherwise each is an output, with an issue if several references are given.
    /// Their coherence is unknown.
    ///
    /// # Errors
    /// No recording, no complex channel, unequal frequencies.
    pub fn given(recordings: &[Recording]) -> Result<Self, ResponseError> {
        let first = recordings.first().ok_or(ResponseError::Nothing)?;
        let frequency_hz = first.grid.places();
        if let Some(other) = recordings
            .iter()
            .find(|recording| recording.grid.places() != frequency_hz)
        {
            return Err(ResponseError::Frequencies {
                first: first.name.clone(),
                other: other.name.clone(),
            });
        }
        let all = recordings.iter().flat_map(|recording| &recording.channels);
        let channels: Vec<(&Channel, &Vec<f64>)> = all
            .filter_map(|channel| Some((channel, channel.imaginary.as_ref()?)))
            .collect();
        if channels.is_empty() {
            return Err(ResponseError::NotComplex {
                recording: first.name.clone(),
            });
        }
        let (
            FunctionChannels {
                outputs,
                references,
                order,
            },
            odd,
        ) = sides(
            &channels
                .iter()
                .map(|(channel, _)| *channel)
                .collect::<Vec<_>>(),
        );
        let function = |k: &usize| {
            let (channel, imaginary) = channels[*k];
            FrequencyResponse {
                frequency_hz: frequency_hz.clone(),
                value: channel
                    .values
                    .iter()
                    .zip(imaginary)
                    .map(|(re, im)| Complex::new(*re, *im))
                    .collect(),
                coherence: vec![1.0; frequency_hz.len()],
                blocks: 1,
                sight: WindowBias::Whole,
                without: Vec::new(),
            }
        };
        let each = || order.iter().map(|k| channels[*k].0);
        let names = match &references[..] {
            [] | [_] => outputs.clone(),
            _ => outputs
                .iter()
                .flat_map(|output| {
                    references
                        .iter()
                        .map(move |reference| format!("{output} from {reference}"))
                })
                .collect(),
        };
        Ok(Self {
            names,
            units: each().map(|channel| channel.unit.clone()).collect(),
            quantities: each()
                .map(|channel| Unit::responds(&channel.unit).unwrap_or(channel.quantity))
                .collect(),
            input: String::new(),
            inputs: each()
                .map(|channel| Unit::per(&channel.unit).unwrap_or(Quantity::Unknown))
                .collect(),
            functions: order.iter().map(function).collect(),
            hits: Vec::new(),
            block_s: None,
            window_decay_per_s: 0.0,
            findings: recordings
                .iter()
                .flat_map(|recording| recording.findings.clone())
                .chain(odd)
                .collect(),
            outputs,
            references,
        })
    }
}

/// Outputs and references in order of first occurrence, and an issue if they are inconsistent.
fn sides(channels: &[&Channel]) -> (FunctionChannels, Option<Issue>) {
    let references = distinct(channels.iter().map(|channel| channel.reference.clone()));
    let told: Vec<String> = references
        .iter()
        .filter(|name| !name.is_empty())
        .cloned()
        .collect();
    let alone = |references: Vec<String>| FunctionChannels {
        outputs: channels
            .iter()
            .map(|channel| channel.name.clone())
            .collect(),
        references,
        order: (0..channels.len()).collect(),
    };
    if told.len() < 2 {
        let one = if references.len() == 1 {
            told
        } else {
            Vec::new()
        };
        return (alone(one), None);
    }
    let places: Vec<String> = channels.iter().map(|channel| output(channel)).collect();
    let outputs = distinct(places.iter().cloned());
    let mut order = Vec::new();
    for (output, reference) in outputs
        .iter()
        .flat_map(|output| references.iter().map(move |reference| (output, reference)))
    {
        let of_pair: Vec<usize> = (0..channels.len())
            .filter(|k| places[*k] == *output && channels[*k].reference == *reference)
            .collect();
        let [one] = of_pair[..] else {
            let to = if reference.is_empty() {
                "an unspecified reference"
            } else {
                reference
            };
            let about = format!(
                "the functions have {} references, and {} of output {output} to {to} where one is \
                expected; each function is used as an output of one reference",
                told.len(),
                of_pair.len()
            );
            return (
                alone(Vec::new()),
                Some(Issue::new(IssueKind::Assumed, channels.len(), None, about)),
            );
        };
        order.push(one);
    }
    // Name of the sensor, or its location if several share the name.
    let named: Vec<String> = order
        .iter()
        .step_by(references.len())
        .map(|k| bare(channels[*k]).to_owned())
        .collect();
    let outputs = if distinct(named.iter().cloned()).len() == named.len() {
        named
    } else {
        outputs
    };
    (
        FunctionChannels {
            outputs,
            references,
            order,
        },
        None,
    )
}

/// Location and direction of an output, or its name if neither is given.
fn output(channel: &Channel) -> String {
    let place = place(channel);
    if place.is_empty() {
        bare(channel).to_owned()
    } else {
        place
    }
}

/// Name without the reference suffix.
fn bare(channel: &Channel) -> &str {
    let behind = channel
        .name
        .strip_suffix(channel.reference.as_str())
        .and_then(|name| name.strip_suffix(" from "));
    behind.unwrap_or(&channel.name)
}

fn distinct(all: impl Iterator<Item = String>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for one in all {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}
