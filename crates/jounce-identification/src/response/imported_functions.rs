//! Imported response functions.

use jounce_fft::Complex;

use super::forces::{force_position, unique};
use super::{MeasuredResponses, ResponseError};
use jounce_data::recording::{Channel, Issue, IssueKind, Quantity, Recording, Unit};
use jounce_signal::spectral::{FrequencyResponse, WindowBias};

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
    pub fn from_functions(recordings: &[Recording]) -> Result<Self, ResponseError> {
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
        let all: Vec<&Channel> = channels.iter().map(|(channel, _)| *channel).collect();
        let (sides, issue) = channel_sides(&all);
        let ordered_channels = || sides.order.iter().map(|k| channels[*k].0);
        Ok(Self {
            names: sides.names(),
            units: ordered_channels()
                .map(|channel| channel.unit.clone())
                .collect(),
            quantities: ordered_channels()
                .map(|channel| Unit::responds(&channel.unit).unwrap_or(channel.quantity))
                .collect(),
            input: String::new(),
            inputs: ordered_channels()
                .map(|channel| Unit::per(&channel.unit).unwrap_or(Quantity::Unknown))
                .collect(),
            functions: sides
                .order
                .iter()
                .map(|k| function(channels[*k], &frequency_hz))
                .collect(),
            hits: Vec::new(),
            block_s: None,
            window_decay_per_s: 0.0,
            issues: recordings
                .iter()
                .flat_map(|recording| recording.issues.clone())
                .chain(issue)
                .collect(),
            outputs: sides.outputs,
            references: sides.references,
        })
    }
}

/// Response function of a complex channel; its coherence is unknown.
fn function(
    (channel, imaginary): (&Channel, &Vec<f64>),
    frequency_hz: &[f64],
) -> FrequencyResponse {
    FrequencyResponse {
        frequency_hz: frequency_hz.to_vec(),
        value: channel
            .values
            .iter()
            .zip(imaginary)
            .map(|(re, im)| Complex::new(*re, *im))
            .collect(),
        coherence: vec![1.0; frequency_hz.len()],
        blocks: 1,
        window_bias: WindowBias::Whole,
        leave_one_out: Vec::new(),
    }
}

impl FunctionChannels {
    /// Every function as an output of one reference.
    fn single_reference(channels: &[&Channel], references: Vec<String>) -> Self {
        Self {
            outputs: channels
                .iter()
                .map(|channel| channel.name.clone())
                .collect(),
            references,
            order: (0..channels.len()).collect(),
        }
    }

    /// Name of each function.
    fn names(&self) -> Vec<String> {
        match &self.references[..] {
            [] | [_] => self.outputs.clone(),
            references => (self.outputs.iter())
                .flat_map(|output| {
                    references
                        .iter()
                        .map(move |reference| format!("{output} from {reference}"))
                })
                .collect(),
        }
    }
}

/// Outputs and references in order of first occurrence, and an issue if they are inconsistent.
fn channel_sides(channels: &[&Channel]) -> (FunctionChannels, Option<Issue>) {
    let references = unique(channels.iter().map(|channel| channel.reference.clone()));
    let named_references: Vec<String> = references
        .iter()
        .filter(|name| !name.is_empty())
        .cloned()
        .collect();
    let named = named_references.len();
    if named < 2 {
        let one = if references.len() == 1 {
            named_references
        } else {
            Vec::new()
        };
        return (FunctionChannels::single_reference(channels, one), None);
    }
    let positions: Vec<String> = channels.iter().map(|channel| output(channel)).collect();
    let outputs = unique(positions.iter().cloned());
    let mut order = Vec::new();
    for (output, reference) in outputs
        .iter()
        .flat_map(|output| references.iter().map(move |reference| (output, reference)))
    {
        let of_pair: Vec<usize> = (0..channels.len())
            .filter(|k| positions[*k] == *output && channels[*k].reference == *reference)
            .collect();
        let [one] = of_pair[..] else {
            let message = incomplete_message(named, of_pair.len(), (output, reference));
            return (
                FunctionChannels::single_reference(channels, Vec::new()),
                Some(Issue::new(
                    IssueKind::Assumed,
                    channels.len(),
                    None,
                    message,
                )),
            );
        };
        order.push(one);
    }
    // Name of the sensor, or its location if several share the name.
    let short_names: Vec<String> = order
        .iter()
        .step_by(references.len())
        .map(|k| short_name(channels[*k]).to_owned())
        .collect();
    let are_different = unique(short_names.iter().cloned()).len() == short_names.len();
    (
        FunctionChannels {
            outputs: if are_different { short_names } else { outputs },
            references,
            order,
        },
        None,
    )
}

/// Message where there is not one function of each output to each reference.
fn incomplete_message(
    references: usize,
    functions: usize,
    (output, reference): (&str, &str),
) -> String {
    let to = if reference.is_empty() {
        "an unspecified reference"
    } else {
        reference
    };
    format!(
        "the functions have {references} references, and {functions} of output {output} to {to} \
        where one is expected; each function is used as an output of one reference"
    )
}

/// Location and direction of an output, or its name if neither is given.
fn output(channel: &Channel) -> String {
    let position = force_position(channel);
    if position.is_empty() {
        short_name(channel).to_owned()
    } else {
        position
    }
}

/// Name without the reference suffix.
fn short_name(channel: &Channel) -> &str {
    let stripped = channel
        .name
        .strip_suffix(channel.reference.as_str())
        .and_then(|name| name.strip_suffix(" from "));
    stripped.unwrap_or(&channel.name)
}
