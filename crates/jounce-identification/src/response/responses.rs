//! Responses of a structure to the force of a hammer or of a shaker.

use jounce_signal::{Samples, SignalError};

use super::ResponseError;
use super::excitation::{self, Excitation, input};
use super::forces::{ReferenceRecords, check_sensors, references};
use jounce_data::recording::{Channel, Issue, IssueKind, Quantity, Recording};
use jounce_signal::spectral::{
    FrequencyResponse, ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings, SpectralError,
    impact,
};

/// Choice of channels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChannelChoice {
    /// Excitation.
    pub excitation: Excitation,
    /// Responses; empty for all channels except the input.
    pub responses: Vec<String>,
}

/// Response functions over common frequencies, and the data they are from.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredResponses {
    /// Name of each output.
    pub outputs: Vec<String>,
    /// Locations of the input, or its channel if none is given; empty for imported response
    /// functions without references.
    pub references: Vec<String>,
    /// Name of each response: output `o` to reference `i` is at `o * references + i`. With one
    /// reference it is the name of the output.
    pub names: Vec<String>,
    /// Unit of each response: output unit per input unit.
    pub units: Vec<String>,
    /// Quantity of each output.
    pub quantities: Vec<Quantity>,
    /// Channel of the input; empty for imported response functions.
    pub input: String,
    /// Quantity of each input: a force, the motion of the base, a voltage; unknown if the unit of a
    /// function does not determine it.
    pub inputs: Vec<Quantity>,
    /// Response functions.
    pub functions: Vec<FrequencyResponse>,
    /// Hits; empty under a shaker, or for imported response functions.
    pub hits: Vec<ImpactHit>,
    /// Length of a block, s; `None` for imported response functions.
    pub block_s: Option<f64>,
    /// Damping that the window adds to every mode, 1/s.
    pub window_decay_per_s: f64,
    /// Data-quality issues of the recordings.
    pub issues: Vec<Issue>,
}

impl MeasuredResponses {
    /// Computes the responses of a hammer or shaker test from uniform recordings with equal
    /// channels, each with one or more hits or a continuous input. An input that is not a force is
    /// averaged in blocks, like a shaker's. Recordings of each force location are averaged
    /// separately, over blocks of one length.
    ///
    /// # Errors
    /// A channel that does not exist or is not a force; the force as its own response; only some
    /// forces with a location; sensors that move; no channel other than the force; errors of
    /// [`impact`].
    pub fn of_hits(
        records: &[Recording],
        choice: &ChannelChoice,
        settings: &ImpactSettings,
    ) -> Result<Self, ResponseError> {
        let first = records.first().ok_or(ResponseError::Nothing)?;
        let input_channel = input(first, choice)?;
        let settings = &excitation::settings(records, choice, settings)?;
        let outputs: Vec<String> = match &choice.responses[..] {
            [] => first
                .channels
                .iter()
                .map(|channel| channel.name.clone())
                .filter(|name| *name != input_channel.name)
                .collect(),
            names => names
                .iter()
                .map(|name| Ok(first.channel(name)?.name.clone()))
                .collect::<Result<_, ResponseError>>()?,
        };
        if outputs.contains(&input_channel.name) {
            return Err(ResponseError::OwnResponse {
                recording: first.name.clone(),
                force: input_channel.name.clone(),
            });
        }
        if outputs.is_empty() {
            return Err(ResponseError::NoResponse {
                recording: first.name.clone(),
                force: input_channel.name.clone(),
            });
        }
        let (forces, position_issue) = references(records, choice)?;
        check_sensors(records, &outputs)?;
        let results = analyse_references(&forces, choice, &outputs, settings)?;
        let channels = outputs
            .iter()
            .map(|name| first.channel(name))
            .collect::<Result<Vec<_>, _>>()?;
        let several_inputs = forces.len() > 1;
        let name = |o: usize, i: usize| {
            if several_inputs {
                format!("{} from {}", outputs[o], forces[i].name)
            } else {
                outputs[o].clone()
            }
        };
        let pairs = || (0..outputs.len()).flat_map(|o| (0..forces.len()).map(move |i| (o, i)));
        Ok(Self {
            names: pairs().map(|(o, i)| name(o, i)).collect(),
            units: pairs()
                .map(|(o, _)| excitation::unit(channels[o], input_channel))
                .collect(),
            quantities: pairs().map(|(o, _)| channels[o].quantity).collect(),
            input: input_channel.name.clone(),
            inputs: pairs()
                .map(|_| excitation::quantity(input_channel))
                .collect(),
            functions: pairs()
                .map(|(o, i)| results[i].responses[o].clone())
                .collect(),
            hits: in_order(&forces, &results),
            block_s: Some(results[0].block_s),
            window_decay_per_s: results[0].window_decay_per_s,
            references: forces.iter().map(|force| force.name.clone()).collect(),
            issues: records
                .iter()
                .flat_map(|recording| recording.issues.clone())
                .chain(input_channel.head().assumed_unit_issue(Quantity::Force))
                .chain(position_issue)
                .chain(
                    results
                        .iter()
                        .find(|result| result.is_sweep)
                        .map(|result| sweep_issue(settings, result.block_s)),
                )
                .collect(),
            outputs,
        })
    }

    /// Factor from a response to an acceleration, with its values in m/s^2, to values per g, and
    /// the resulting unit; `None` for other inputs, and for a response in the unit of its input.
    pub fn per_g(&self, response: usize) -> Option<(f64, String)> {
        let numerator = self.units[response]
            .strip_suffix("/(m/s^2)")
            .filter(|_| self.inputs[response] == Quantity::Acceleration)?;
        (self.quantities[response] != Quantity::Acceleration)
            .then(|| (STANDARD_GRAVITY_M_S2, format!("{numerator}/g")))
    }

    /// True for a response in the unit of its input, a pure number.
    pub fn is_transmissibility(&self, response: usize) -> bool {
        self.inputs[response] != Quantity::Unknown
            && self.quantities[response] == self.inputs[response]
    }
}

/// m/s^2 in a g (NIST SP 811).
const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Responses of the recordings of each location. Unless a length is given, blocks have the shortest
/// length of any location.
fn analyse_references(
    forces: &[ReferenceRecords<'_>],
    choice: &ChannelChoice,
    outputs: &[String],
    settings: &ImpactSettings,
) -> Result<Vec<ImpactResponses>, ResponseError> {
    let analyse = |force: &ReferenceRecords<'_>,
                   settings: &ImpactSettings|
     -> Result<ImpactResponses, ResponseError> {
        let blocks = force
            .records
            .iter()
            .map(|(_, record)| impact_record(record, choice, outputs))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(impact(&blocks, settings)?)
    };
    let rates = forces
        .iter()
        .filter_map(|force| force.records.first())
        .map(|(_, record)| record.rate())
        .collect::<Vec<f64>>();
    if let Some(other_hz) = rates
        .iter()
        .copied()
        .find(|rate| (rate / rates[0] - 1.0).abs() > 1e-6)
    {
        return Err(ResponseError::Spectral(SpectralError::Rates {
            first_hz: rates[0],
            other_hz,
        }));
    }
    let found = forces
        .iter()
        .map(|force| analyse(force, settings))
        .collect::<Result<Vec<_>, _>>()?;
    let least_block_s = found
        .iter()
        .map(|analyse| analyse.block_s)
        .fold(f64::INFINITY, f64::min);
    let settings = ImpactSettings {
        block_s: Some(least_block_s),
        ..*settings
    };
    let with_common_block = |(force, found): (&ReferenceRecords<'_>, ImpactResponses)| {
        // Only lengths of whole samples differ by more than roundoff.
        let has_common_block = (found.block_s - least_block_s) * rates[0] < 0.5;
        if has_common_block {
            Ok(found)
        } else {
            analyse(force, &settings)
        }
    };
    forces.iter().zip(found).map(with_common_block).collect()
}

/// Hits of all locations, each with the index of its record, in the order of the records.
fn in_order(forces: &[ReferenceRecords<'_>], results: &[ImpactResponses]) -> Vec<ImpactHit> {
    let hits_of = |(force, result): (&ReferenceRecords<'_>, &ImpactResponses)| {
        let with_record_index = |hit: &ImpactHit| ImpactHit {
            record: force.records[hit.record].0,
            ..hit.clone()
        };
        result
            .hits
            .iter()
            .map(with_record_index)
            .collect::<Vec<_>>()
    };
    let mut hits: Vec<ImpactHit> = forces.iter().zip(results).flat_map(hits_of).collect();
    hits.sort_by_key(|hit| hit.record);
    hits
}

/// Reports how a sweep affects its blocks.
fn sweep_issue(settings: &ImpactSettings, block_s: f64) -> Issue {
    let message = match settings.block_s {
        None => format!(
            "the force is a sweep: each recording is one block of {block_s:.4} s without a \
            window, and the coherence of a single block has no meaning"
        ),
        Some(_) => format!(
            "the force is a sweep and drives each line in only a few blocks of {block_s:.4} s: \
            peaks are underestimated; omit the block length, then each recording is one block"
        ),
    };
    Issue::new(IssueKind::Assumed, 1, None, message)
}

fn impact_record<'a>(
    recording: &'a Recording,
    choice: &ChannelChoice,
    names: &[String],
) -> Result<ImpactRecord<'a>, ResponseError> {
    let signal_error = |fault: SignalError| ResponseError::Spectral(SpectralError::Signal(fault));
    let samples = |channel: &'a Channel| {
        Samples::new(&channel.values, recording.rate()).map_err(signal_error)
    };
    let responses = names
        .iter()
        .map(|name| samples(recording.channel(name)?))
        .collect::<Result<_, _>>()?;
    Ok(ImpactRecord {
        force: samples(input(recording, choice)?)?,
        responses,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_data::recording::{Grid, IssueKind, Over};

    fn hit_recording(name: &str, place: &str) -> Recording {
        let values: Vec<f64> = (0..1000)
            .map(|k| if (20..30).contains(&k) { 50.0 } else { 0.0 })
            .collect();
        let force = Channel {
            place: place.to_owned(),
            ..Channel::new("force", Quantity::Force, "N", values.clone())
        };
        let channels = vec![
            force,
            Channel::new("a", Quantity::Acceleration, "m/s^2", values),
        ];
        Recording {
            name: name.to_owned(),
            over: Over::Time,
            grid: Grid::even(0.0, 1e-3, 1000).unwrap(),
            channels,
            issues: Vec::new(),
        }
    }

    #[test]
    fn hits_at_several_positions_are_not_averaged() {
        let references_of = |records: &[Recording]| {
            MeasuredResponses::of_hits(
                records,
                &ChannelChoice::default(),
                &ImpactSettings::default(),
            )
        };
        let found = references_of(&[
            hit_recording("one", "mid"),
            hit_recording("two", "end"),
            hit_recording("three", "mid"),
        ])
        .unwrap();
        assert_eq!(
            (&found.references[..], &found.outputs[..]),
            (
                &["mid".to_owned(), "end".to_owned()][..],
                &["a".to_owned()][..]
            )
        );
        assert_eq!(
            (&found.names[..], found.functions.len()),
            (&["a from mid".to_owned(), "a from end".to_owned()][..], 2)
        );
        assert_eq!(
            (found.functions[0].blocks, found.functions[1].blocks),
            (2, 1)
        );
        assert_eq!(
            found.hits.iter().map(|hit| hit.record).collect::<Vec<_>>(),
            [0, 1, 2]
        );
        let message = references_of(&[
            hit_recording("one", "mid"),
            hit_recording("two", "end"),
            hit_recording("three", ""),
        ])
        .unwrap_err()
        .to_string();
        assert!(
            message.contains("(mid, end), but the place is missing in three"),
            "{message}"
        );
        assert!(
            references_of(&[hit_recording("one", "mid"), hit_recording("two", "mid")])
                .unwrap()
                .issues
                .is_empty()
        );
        let missing = references_of(&[hit_recording("one", "mid"), hit_recording("two", "")])
            .unwrap()
            .issues;
        assert!(
            missing.len() == 1
                && missing[0].kind == IssueKind::Assumed
                && missing[0].about.starts_with("1 of 2"),
            "{missing:?}"
        );
        assert!(
            references_of(&[hit_recording("one", "")])
                .unwrap()
                .issues
                .is_empty()
        );
    }

    /// A sensor that moves under one name would average different functions.
    #[test]
    fn moved_sensor_is_reported() {
        let at = |name: &str, place: &str| {
            let mut record = hit_recording(name, "mid");
            record.channels[1].place = place.to_owned();
            record
        };
        let references_of = |records: &[Recording]| {
            MeasuredResponses::of_hits(
                records,
                &ChannelChoice::default(),
                &ImpactSettings::default(),
            )
        };
        let message = references_of(&[at("one", "tip"), at("two", "root")])
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("tip in one, and at root in two"),
            "{message}"
        );
        assert!(references_of(&[at("one", "tip"), at("two", "tip")]).is_ok());
    }

    /// The force location survives in the formats that support it.
    #[test]
    fn force_position_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        for (direction, place) in [
            ("uff", "mid"),
            ("uff", "node 7"),
            ("parquet", "beam.hammer"),
            ("parquet", "node 7"),
            ("csv", "free end"),
        ] {
            let path = folder.path().join(format!("hit.{direction}"));
            let mut hit = hit_recording("one", place);
            hit.channels[0].direction = "-z".to_owned();
            jounce_data::write::write(&hit, &path).unwrap();
            let read = jounce_data::read::file(&path).unwrap().recordings.remove(0);
            let force = read.channel("force").unwrap();
            assert_eq!(
                (force.place.as_str(), force.direction.as_str()),
                (place, "-z"),
                "{direction}"
            );
            assert_eq!(
                read.channel("a").unwrap().place,
                if direction == "uff" { "node 2" } else { "" }
            );
        }
    }

    #[test]
    fn a_force_that_responds_to_itself_is_refused() {
        for responses in [
            vec!["force".to_owned()],
            vec!["a".to_owned(), "force".to_owned()],
        ] {
            let choice = ChannelChoice {
                responses,
                ..ChannelChoice::default()
            };
            let fault = MeasuredResponses::of_hits(
                &[hit_recording("one", "")],
                &choice,
                &ImpactSettings::default(),
            )
            .unwrap_err();
            assert!(
                matches!(&fault, ResponseError::OwnResponse { .. }),
                "{fault}"
            );
        }
    }
}
