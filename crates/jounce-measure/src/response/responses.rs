//! The responses of a structure to the force of a hammer or of a shaker.

use jounce::signal::{Samples, SignalError};

use super::ResponseError;
use super::excitation::{self, Excitation, input};
use super::forces::{ReferenceRecords, check_sensors, references};
use crate::spectral::{
    FrequencyResponse, ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings, SpectralError,
    impact,
};
use jounce_data::recording::{Channel, Issue, IssueKind, Quantity, Recording};

/// Which channels are what.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChannelChoice {
    /// The input.
    pub excitation: Excitation,
    /// The responses; empty for all channels but the input.
    pub responses: Vec<String>,
}

/// Response functions over common frequencies, and what they rest on.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredResponses {
    /// Name of each output.
    pub outputs: Vec<String>,
    /// Where the input acts: its places, or its channel where none is told; none where response functions were given that tell none.
    pub references: Vec<String>,
    /// Name of each response: that of output `o` to reference `i` at `o * references + i`. It is that of the output alone where there are no
    /// several references.
    pub names: Vec<String>,
    /// Unit of each: that of the output per that of the input.
    pub units: Vec<String>,
    /// What each measures.
    pub quantities: Vec<Quantity>,
    /// The channel of the input; empty where response functions were given.
    pub input: String,
    /// What each is a response to: a force, the motion of the base, a voltage; unknown where the unit of a function tells none.
    pub inputs: Vec<Quantity>,
    /// The response functions.
    pub functions: Vec<FrequencyResponse>,
    /// The hits; none under a shaker, or where response functions were given.
    pub hits: Vec<ImpactHit>,
    /// Length of a block, s; none where response functions were given.
    pub block_s: Option<f64>,
    /// Damping that the window adds to every mode, 1/s.
    pub window_decay_per_s: f64,
    /// What is odd about the recordings.
    pub findings: Vec<Issue>,
}

impl MeasuredResponses {
    /// The responses of a hammer or shaker test: recordings over even times, with one or more hits in each or an input that goes on, the
    /// channels the same in all. An input that is no force is averaged in blocks, as that of a shaker. Recordings of each place of the force are averaged for themselves, over blocks of one length.
    ///
    /// # Errors
    /// A channel that is not there or no force, the force as its own response, forces some of which tell their places, sensors that move, nothing beside the force, what
    /// [`impact`] refuses.
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

    /// For a response to an acceleration, its values in m/s^2 times this are per g, and the unit that they then have; none for a response to
    /// something else, and for one in the unit of its input.
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

/// What the recordings of each place give. Unless a length is told, blocks are as long as the shortest ones of any place.
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

/// The hits of all places, each with the number of its record, in the order of the records.
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

/// What a sweep means for its blocks.
fn swept(settings: &ImpactSettings, block_s: f64) -> Issue {
    let about = match settings.block_s {
        None => format!(
            "the force sweeps: each recording is one block of {block_s:.4} s without a window, and the coherence of a single one tells nothing"
        ),
        Some(_) => format!(
            "the force sweeps, and drives each line in few blocks of {block_s:.4} s: peaks come out low; leave out the length of a block, then each \
             recording is one"
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
        assert!(told.contains("(mid, end), and three tell none"), "{told}");
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

    /// One name for a sensor that moves would average different functions.
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

    /// The place of a force survives the formats that can hold it.
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
