//! Responses of a structure to the force of a hammer or of a shaker.

use jounce_core::signal::{Samples, SignalError};

use super::ResponseError;
use super::excitation::{self, Excitation, input};
use super::forces::{ReferenceRecords, check_sensors, references};
use crate::spectral::{
    FrequencyResponse, ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings, SpectralError,
    impact,
};
use jounce_data::recording::{Channel, Issue, IssueKind, Quantity, Recording};

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
    pub findings: Vec<Issue>,
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
        chosen: &ChannelChoice,
        settings: &ImpactSettings,
    ) -> Result<Self, ResponseError> {
        let first = records.first().ok_or(ResponseError::Nothing)?;
        let driven = input(first, chosen)?;
        let settings = &excitation::settings(records, chosen, settings)?;
        let outputs: Vec<String> = match &chosen.responses[..] {
            [] => first
                .channels
                .iter()
                .map(|channel| channel.name.clone())
                .filter(|name| *name != driven.name)
                .collect(),
            wanted => wanted
                .iter()
                .map(|name| Ok(first.channel(name)?.name.clone()))
                .collect::<Result<_, ResponseError>>()?,
        };
        if outputs.contains(&driven.name) {
            return Err(ResponseError::OwnResponse {
                recording: first.name.clone(),
                force: driven.name.clone(),
            });
        }
        if outputs.is_empty() {
            return Err(ResponseError::NoResponse {
                recording: first.name.clone(),
                force: driven.name.clone(),
            });
        }
        let (forces, place) = references(records, chosen)?;
        check_sensors(records, &outputs)?;
        let answers = answers(&forces, chosen, &outputs, settings)?;
        let channels = outputs
            .iter()
            .map(|name| first.channel(name))
            .collect::<Result<Vec<_>, _>>()?;
        let several = forces.len() > 1;
        let name = |o: usize, i: usize| {
            if several {
                format!("{} from {}", outputs[o], forces[i].name)
            } else {
                outputs[o].clone()
            }
        };
        let each = || (0..outputs.len()).flat_map(|o| (0..forces.len()).map(move |i| (o, i)));
        Ok(Self {
            names: each().map(|(o, i)| name(o, i)).collect(),
            units: each()
                .map(|(o, _)| excitation::unit(channels[o], driven))
                .collect(),
            quantities: each().map(|(o, _)| channels[o].quantity).collect(),
            input: driven.name.clone(),
            inputs: each().map(|_| excitation::quantity(driven)).collect(),
            functions: each()
                .map(|(o, i)| answers[i].responses[o].clone())
                .collect(),
            hits: in_order(&forces, &answers),
            block_s: Some(answers[0].block_s),
            window_decay_per_s: answers[0].window_decay_per_s,
            references: forces.iter().map(|force| force.name.clone()).collect(),
            findings: records
                .iter()
                .flat_map(|recording| recording.findings.clone())
                .chain(driven.head().assumed(Quantity::Force))
                .chain(place)
                .chain(
                    answers
                        .iter()
                        .find(|answer| answer.swept)
                        .map(|answer| swept(settings, answer.block_s)),
                )
                .collect(),
            outputs,
        })
    }

    /// Factor from a response to an acceleration, with its values in m/s^2, to values per g, and
    /// the resulting unit; `None` for other inputs, and for a response in the unit of its input.
    pub fn per_g(&self, response: usize) -> Option<(f64, String)> {
        let above = self.units[response]
            .strip_suffix("/(m/s^2)")
            .filter(|_| self.inputs[response] == Quantity::Acceleration)?;
        (self.quantities[response] != Quantity::Acceleration)
            .then(|| (STANDARD_GRAVITY_M_S2, format!("{above}/g")))
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
fn answers(
    forces: &[ReferenceRecords<'_>],
    chosen: &ChannelChoice,
    outputs: &[String],
    settings: &ImpactSettings,
) -> Result<Vec<ImpactResponses>, ResponseError> {
    let answer = |force: &ReferenceRecords<'_>,
                  settings: &ImpactSettings|
     -> Result<ImpactResponses, ResponseError> {
        let blocks = force
            .records
            .iter()
            .map(|(_, record)| impact_record(record, chosen, outputs))
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
        .map(|force| answer(force, settings))
        .collect::<Result<Vec<_>, _>>()?;
    let shortest_s = found
        .iter()
        .map(|answer| answer.block_s)
        .fold(f64::INFINITY, f64::min);
    let settings = ImpactSettings {
        block_s: Some(shortest_s),
        ..*settings
    };
    let again = |(force, found): (&ReferenceRecords<'_>, ImpactResponses)| {
        // Only lengths of whole samples differ by more than roundoff.
        let alike = (found.block_s - shortest_s) * rates[0] < 0.5;
        if alike {
            Ok(found)
        } else {
            answer(force, &settings)
        }
    };
    forces.iter().zip(found).map(again).collect()
}

/// Hits of all locations, each with the index of its record, in the order of the records.
fn in_order(forces: &[ReferenceRecords<'_>], answers: &[ImpactResponses]) -> Vec<ImpactHit> {
    let of = |(force, answer): (&ReferenceRecords<'_>, &ImpactResponses)| {
        let numbered = |hit: &ImpactHit| ImpactHit {
            record: force.records[hit.record].0,
            ..hit.clone()
        };
        answer.hits.iter().map(numbered).collect::<Vec<_>>()
    };
    let mut hits: Vec<ImpactHit> = forces.iter().zip(answers).flat_map(of).collect();
    hits.sort_by_key(|hit| hit.record);
    hits
}

/// Reports how a sweep affects its blocks.
fn swept(settings: &ImpactSettings, block_s: f64) -> Issue {
    let about = match settings.block_s {
        None => format!(
            "the force is a sweep: each recording is one block of {block_s:.4} s without a \
            window, and the coherence of a single block has no meaning"
        ),
        Some(_) => format!(
            "the force is a sweep and drives each line in only a few blocks of {block_s:.4} s: \
            peaks are underestimated; omit the block length, then each recording is one block"
        ),
    };
    Issue::new(IssueKind::Assumed, 1, None, about)
}

fn impact_record<'a>(
    recording: &'a Recording,
    chosen: &ChannelChoice,
    names: &[String],
) -> Result<ImpactRecord<'a>, ResponseError> {
    let told = |fault: SignalError| ResponseError::Spectral(SpectralError::Signal(fault));
    let samples =
        |channel: &'a Channel| Samples::new(&channel.values, recording.rate()).map_err(told);
    let responses = names
        .iter()
        .map(|name| samples(recording.channel(name)?))
        .collect::<Result<_, _>>()?;
    Ok(ImpactRecord {
        force: samples(input(recording, chosen)?)?,
        responses,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_data::recording::{Grid, IssueKind, Over};

    fn struck(name: &str, place: &str) -> Recording {
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
            findings: Vec::new(),
        }
    }

    #[test]
    fn hits_at_several_places_are_not_averaged() {
        let of = |records: &[Recording]| {
            MeasuredResponses::of_hits(
                records,
                &ChannelChoice::default(),
                &ImpactSettings::default(),
            )
        };
        let found = of(&[
            struck("one", "mid"),
            struck("two", "end"),
            struck("three", "mid"),
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
        let told = of(&[
            struck("one", "mid"),
            struck("two", "end"),
            struck("three", ""),
        ])
        .unwrap_err()
        .to_string();
        assert!(
            told.contains("(mid, end), but the place is missing in three"),
            "{told}"
        );
        assert!(
            of(&[struck("one", "mid"), struck("two", "mid")])
                .unwrap()
                .findings
                .is_empty()
        );
        let silent = of(&[struck("one", "mid"), struck("two", "")])
            .unwrap()
            .findings;
        assert!(
            silent.len() == 1
                && silent[0].kind == IssueKind::Assumed
                && silent[0].about.starts_with("1 of 2"),
            "{silent:?}"
        );
        assert!(of(&[struck("one", "")]).unwrap().findings.is_empty());
    }

    /// A sensor that moves under one name would average different functions.
    #[test]
    fn a_sensor_that_moves_is_told() {
        let at = |name: &str, place: &str| {
            let mut record = struck(name, "mid");
            record.channels[1].place = place.to_owned();
            record
        };
        let of = |records: &[Recording]| {
            MeasuredResponses::of_hits(
                records,
                &ChannelChoice::default(),
                &ImpactSettings::default(),
            )
        };
        let told = of(&[at("one", "tip"), at("two", "root")])
            .unwrap_err()
            .to_string();
        assert!(told.contains("tip in one, and at root in two"), "{told}");
        assert!(of(&[at("one", "tip"), at("two", "tip")]).is_ok());
    }

    /// The force location survives in the formats that support it.
    #[test]
    fn a_place_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        for (ending, place) in [
            ("uff", "mid"),
            ("uff", "node 7"),
            ("parquet", "beam.hammer"),
            ("parquet", "node 7"),
            ("csv", "free end"),
        ] {
            let path = folder.path().join(format!("hit.{ending}"));
            let mut hit = struck("one", place);
            hit.channels[0].direction = "-z".to_owned();
            crate::write::write(&hit, &path).unwrap();
            let read = jounce_data::read::file(&path).unwrap().recordings.remove(0);
            let force = read.channel("force").unwrap();
            assert_eq!(
                (force.place.as_str(), force.direction.as_str()),
                (place, "-z"),
                "{ending}"
            );
            assert_eq!(
                read.channel("a").unwrap().place,
                if ending == "uff" { "node 2" } else { "" }
            );
        }
    }

    #[test]
    fn a_force_that_responds_to_itself_is_refused() {
        for responses in [
            vec!["force".to_owned()],
            vec!["a".to_owned(), "force".to_owned()],
        ] {
            let chosen = ChannelChoice {
                responses,
                ..ChannelChoice::default()
            };
            let fault = MeasuredResponses::of_hits(
                &[struck("one", "")],
                &chosen,
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
