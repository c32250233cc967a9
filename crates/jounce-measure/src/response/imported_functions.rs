//! Response functions that were measured before.

use realfft::num_complex::Complex;

use super::forces::place;
use super::{MeasuredResponses, ResponseError};
use crate::spectral::{FrequencyResponse, WindowBias};
use jounce_data::recording::{Channel, Issue, IssueKind, Quantity, Recording, Unit};

/// Which function stands for which output and which reference.
struct FunctionChannels {
    outputs: Vec<String>,
    references: Vec<String>,
    /// Numbers of the functions: that of output `o` to reference `i` at `o * references + i`.
    order: Vec<usize>,
}

impl MeasuredResponses {
    /// Response functions that were measured before: every complex channel of recordings over frequency. Where they tell several references,
    /// and there is one function of each output to each, they are taken so; else each is an output, which is a finding where several references
    /// are told. Nothing is known of their coherence.
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

/// The outputs and references in the order in which they first come, and what is odd about them.
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
                "a reference that is not told"
            } else {
                reference
            };
            let about = format!(
                "the functions tell {} references, and {} of output {output} to {to} where one is due; each function is taken for an output of \
                 one reference",
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
    // The name of the sensor, or where that stands for several, the place.
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

/// Place and direction of an output, its name where neither is told.
fn output(channel: &Channel) -> String {
    let place = place(channel);
    if place.is_empty() {
        bare(channel).to_owned()
    } else {
        place
    }
}

/// The name without the reference that stands behind it.
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
