//! Responses of a structure to the force of a hammer or of a shaker.

use super::ResponseError;
use super::excitation::{self, Excitation, input};
use super::forces::{check_sensors, references};
use super::reference_analysis::{analyse_references, in_order, sweep_issue};
use jounce_data::recording::{Channel, Issue, Quantity, Recording, STANDARD_GRAVITY_M_S2};
use jounce_signal::spectral::{FrequencyResponse, ImpactHit, ImpactSettings};

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
    /// [`jounce_signal::spectral::impact`].
    pub fn of_hits(
        records: &[Recording],
        choice: &ChannelChoice,
        settings: &ImpactSettings,
    ) -> Result<Self, ResponseError> {
        let first = records.first().ok_or(ResponseError::Nothing)?;
        let input_channel = input(first, choice)?;
        let settings = &excitation::settings(records, choice, settings)?;
        let outputs = output_names(first, choice, input_channel)?;
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

/// Names of the responses: those chosen, or all channels except the input.
fn output_names(
    recording: &Recording,
    choice: &ChannelChoice,
    input: &Channel,
) -> Result<Vec<String>, ResponseError> {
    let outputs: Vec<String> = match &choice.responses[..] {
        [] => recording
            .channels
            .iter()
            .map(|channel| channel.name.clone())
            .filter(|name| *name != input.name)
            .collect(),
        names => names
            .iter()
            .map(|name| Ok(recording.channel(name)?.name.clone()))
            .collect::<Result<_, ResponseError>>()?,
    };
    if outputs.contains(&input.name) {
        return Err(ResponseError::OwnResponse {
            recording: recording.name.clone(),
            force: input.name.clone(),
        });
    }
    if outputs.is_empty() {
        return Err(ResponseError::NoResponse {
            recording: recording.name.clone(),
            force: input.name.clone(),
        });
    }
    Ok(outputs)
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

    fn measured(records: &[Recording]) -> Result<MeasuredResponses, ResponseError> {
        MeasuredResponses::of_hits(
            records,
            &ChannelChoice::default(),
            &ImpactSettings::default(),
        )
    }

    #[test]
    fn hits_at_several_positions_are_not_averaged() {
        let found = measured(&[
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
    }

    #[test]
    fn missing_positions_are_assumed_or_refused() {
        let message = measured(&[
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
            measured(&[hit_recording("one", "mid"), hit_recording("two", "mid")])
                .unwrap()
                .issues
                .is_empty()
        );
        let missing = measured(&[hit_recording("one", "mid"), hit_recording("two", "")])
            .unwrap()
            .issues;
        assert!(
            missing.len() == 1
                && missing[0].kind == IssueKind::Assumed
                && missing[0].about.starts_with("1 of 2"),
            "{missing:?}"
        );
        assert!(
            measured(&[hit_recording("one", "")])
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
        let message = measured(&[at("one", "tip"), at("two", "root")])
            .unwrap_err()
            .to_string();
        assert!(
            message.contains("tip in one, and at root in two"),
            "{message}"
        );
        assert!(measured(&[at("one", "tip"), at("two", "tip")]).is_ok());
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
