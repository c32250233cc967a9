//! Frequency responses as features.

use std::path::{Path, PathBuf};

use jounce_linalg::c64;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure;
use jounce_spec::{Gravity, Quantity};

use super::table::FeatureTable;
use crate::fit::model::Conditions;
use crate::fit::{Deviation, FeatureModel, FitError, FitModel};
use jounce_data::read;
use jounce_data::recording::{Channel, Over, Quantity as Measures, Recording, Unit};

/// Measured values of a response.
#[derive(Debug, Clone, PartialEq)]
pub enum MeasuredLines {
    /// Magnitude at frequencies, Hz, per newton or per m/s^2 of the base.
    Magnitude(Vec<f64>, Vec<f64>),
    /// Complex value at frequencies.
    Complex(Vec<f64>, Vec<c64>),
    /// Channel of a file of responses over frequency, between two frequencies; relative to the
    /// features.
    File {
        /// The file.
        path: PathBuf,
        /// Channel name.
        channel: String,
        /// Lines between these frequencies, Hz.
        between_hz: (f64, f64),
    },
}

/// A measured frequency response.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseFeature {
    /// Excitation.
    pub input: FrfInput,
    /// Response output.
    pub output: FrfOutput,
    /// Measured values.
    pub lines: MeasuredLines,
    /// True for the absolute motion of a sensor on the structure while the base moves; false for
    /// motion relative to the base.
    pub absolute: bool,
    /// Relative standard deviation of the magnitude at each line.
    pub deviation: Deviation,
    /// Keys that apply during the test.
    pub set: Vec<(String, String)>,
}

const KEYS: [&str; 12] = [
    "input",
    "output",
    "absolute",
    "frequency",
    "magnitude",
    "re",
    "im",
    "file",
    "channel",
    "between",
    "deviation",
    "set",
];

impl ResponseFeature {
    pub(super) fn read(reader: &mut FeatureTable<'_>) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let input = reader.text("input", "beam.hammer");
        let output = reader
            .text("output", "beam.tip.acceleration")
            .and_then(|text| output(&text, reader));
        let (deviation, set, lines, absolute) = (
            reader.own_deviation(),
            reader.conditions(),
            lines(reader),
            reader.flag("absolute"),
        );
        let input = input?;
        let input = if input == "base" {
            FrfInput::BaseAcceleration
        } else {
            FrfInput::Force(input)
        };
        Some(Self {
            input,
            output: output?,
            lines: lines?,
            absolute,
            deviation,
            set,
        })
    }

    /// Output, input and unit required of a file.
    pub(in crate::fit) fn channels(&self) -> ResponseChannels {
        let output = match self.output {
            FrfOutput::Displacement(_) => Measures::Displacement,
            FrfOutput::Velocity(_) => Measures::Velocity,
            FrfOutput::Acceleration(_) => Measures::Acceleration,
            FrfOutput::Voltage(_) | FrfOutput::LoadVoltage(_) => Measures::Voltage,
        };
        let input = if self.input == FrfInput::BaseAcceleration {
            Measures::Acceleration
        } else {
            Measures::Force
        };
        ResponseChannels {
            output,
            input,
            unit: self.output.unit(&self.input),
        }
    }

    /// Note on a motion over a moving base that is read as relative by default.
    pub(in crate::fit) fn relative_in_words(&self, position: &str) -> Option<String> {
        let is_motion = matches!(
            self.output,
            FrfOutput::Displacement(_) | FrfOutput::Velocity(_) | FrfOutput::Acceleration(_)
        );
        (is_motion && self.input == FrfInput::BaseAcceleration && !self.absolute).then(|| {
            format!(
                "{position}: {} is read as relative to the base; write absolute = true for a sensor \
                on the structure",
                self.output.name()
            )
        })
    }
}

/// Parses the response output, named as in `frf`.
pub(super) fn output(text: &str, reader: &mut FeatureTable<'_>) -> Option<FrfOutput> {
    let result = text.rsplit_once('.').and_then(|(name, kind)| {
        let name = name.to_owned();
        Some(match kind {
            "displacement" => FrfOutput::Displacement(name),
            "velocity" => FrfOutput::Velocity(name),
            "acceleration" => FrfOutput::Acceleration(name),
            "voltage" => FrfOutput::Voltage(name),
            "load_voltage" => FrfOutput::LoadVoltage(name),
            _ => return None,
        })
    });
    if result.is_none() {
        reader.fault("output", format!(
            "output is \"{text}\"; it must be a point with .displacement, .velocity or .acceleration, a patch with .voltage, or a circuit with .load_voltage"
        ));
    }
    result
}

fn lines(reader: &mut FeatureTable<'_>) -> Option<MeasuredLines> {
    if let Some(file) = reader.text_if_any("file", "frf.uff") {
        let channel = reader.text("channel", "tip")?;
        let between = if reader.table.contains_key("between") {
            reader.quantities("between", Quantity::Frequency, "5 Hz")
        } else {
            vec![0.0, f64::INFINITY]
        };
        let [low, high] = between[..] else {
            reader.fault("between", "between must be two frequencies");
            return None;
        };
        return Some(MeasuredLines::File {
            path: file.into(),
            channel,
            between_hz: (low, high),
        });
    }
    let frequency_hz = reader.quantities("frequency", Quantity::Frequency, "9 Hz");
    if reader.table.contains_key("re") || reader.table.contains_key("im") {
        let (re, im) = (
            reader.numbers("re", frequency_hz.len()),
            reader.numbers("im", frequency_hz.len()),
        );
        return Some(MeasuredLines::Complex(
            frequency_hz,
            re.into_iter()
                .zip(im)
                .map(|(re, im)| c64::new(re, im))
                .collect(),
        ));
    }
    let magnitude = reader.numbers("magnitude", frequency_hz.len());
    if magnitude.iter().any(|value| *value <= 0.0) {
        reader.fault("magnitude", "magnitude must contain numbers above 0");
    }
    Some(MeasuredLines::Magnitude(frequency_hz, magnitude))
}

/// Output and input of a response, and its unit.
pub(in crate::fit) struct ResponseChannels {
    output: Measures,
    input: Measures,
    unit: &'static str,
}

impl MeasuredLines {
    /// Returns the lines and the assumptions about them; reads a file if needed.
    pub(in crate::fit) fn read(
        &self,
        folder: &Path,
        position: &str,
        expected: &ResponseChannels,
    ) -> Result<(Self, Option<String>), FitError> {
        let Self::File {
            path,
            channel,
            between_hz,
        } = self
        else {
            return Ok((self.clone(), None));
        };
        let unusable = |reason: String| FitError::File {
            place: position.to_owned(),
            path: path.clone(),
            reason,
        };
        let file_error = |reason: String| unusable(format!("{}: {reason}", path.display()));
        let contents = read::file(&folder.join(path));
        let contents = contents.map_err(|fault| unusable(fault.to_string()))?;
        let over = contents.recordings.into_iter().find(|recording| {
            recording.over == Over::Frequency && recording.channel(channel).is_ok()
        });
        let recording =
            over.ok_or_else(|| file_error(format!("it has no channel {channel} over frequency")))?;
        let result = recording.channel(channel);
        let result = result.map_err(|fault| file_error(fault.to_string()))?;
        let has_unit = expected.check(channel, result).map_err(file_error)?;
        let warning = (!has_unit).then(|| {
            format!(
                "{position}: channel {channel} has no unit; {} is assumed",
                expected.unit
            )
        });
        let lines = Self::of_channel(&recording, result, *between_hz)
            .ok_or_else(|| file_error("no line is in the band".to_owned()))?;
        Ok((lines, warning))
    }

    /// Lines of a channel in a band above 0; `None` without any.
    fn of_channel(
        recording: &Recording,
        channel: &Channel,
        (low_hz, high_hz): (f64, f64),
    ) -> Option<Self> {
        let frequencies = recording.grid.places();
        let is_in_band = |hz: f64| hz > 0.0 && (low_hz..=high_hz).contains(&hz);
        let indices = 0..frequencies.len();
        let indices: Vec<usize> = indices.filter(|k| is_in_band(frequencies[*k])).collect();
        if indices.is_empty() {
            return None;
        }
        let frequency_hz = indices.iter().map(|k| frequencies[*k]).collect();
        Some(match &channel.imaginary {
            Some(imaginary) => Self::Complex(
                frequency_hz,
                indices
                    .iter()
                    .map(|k| c64::new(channel.values[*k], imaginary[*k]))
                    .collect(),
            ),
            None => {
                let sizes = indices.iter().map(|k| channel.values[*k]).collect();
                Self::Magnitude(frequency_hz, sizes)
            }
        })
    }
}

impl ResponseChannels {
    /// Checks the unit of a channel of a file; false if it has none.
    fn check(&self, name: &str, channel: &Channel) -> Result<bool, String> {
        let (has_unit, unit) = (channel.head().has_unit(), channel.unit.as_str());
        let (output, input) = (Unit::responds(unit), Unit::per(unit));
        if has_unit && (output, input) != (Some(self.output), Some(self.input)) {
            return Err(format!(
                "channel {name} is in {unit}, but this response is in {}; correct input, output \
                or unit",
                self.unit
            ));
        }
        Ok(has_unit)
    }
}

/// Response to be evaluated: magnitudes, or real parts followed by imaginary parts.
pub(in crate::fit) struct ResponseModel {
    pub input: FrfInput,
    pub output: FrfOutput,
    pub absolute: bool,
    pub frequency_hz: Vec<f64>,
    pub complex: bool,
    pub conditions: Conditions,
}

impl FeatureModel for ResponseModel {
    fn predict(&self, model: &FitModel<'_>) -> Result<Vec<f64>, FitError> {
        let mut spec = model.spec_at(&self.conditions)?;
        spec.take_drives_away();
        spec.stop.clear();
        spec.gravity = Gravity::default();
        let modes = structure::modes_holding(&spec, model.hold)?;
        let plant = Plant::new(System::assemble(&spec, modes)?)?;
        let result = frf(
            &plant,
            &self.input,
            std::slice::from_ref(&self.output),
            &self.frequency_hz,
        )?;
        let absolute_response = |(h, hz): (&c64, &f64)| {
            if self.absolute {
                h + self.base_response(*hz)
            } else {
                *h
            }
        };
        let value: Vec<c64> = result[0]
            .value
            .iter()
            .zip(&self.frequency_hz)
            .map(absolute_response)
            .collect();
        Ok(match self.complex {
            true => value
                .iter()
                .map(|h| h.re)
                .chain(value.iter().map(|h| h.im))
                .collect(),
            false => value.iter().map(|h| h.norm()).collect(),
        })
    }
}

impl ResponseModel {
    /// Contribution of the base motion to the motion of a sensor on the structure, per acceleration
    /// of the base; 0 for a voltage or under a force.
    fn base_response(&self, hz: f64) -> c64 {
        let jw = c64::new(0.0, std::f64::consts::TAU * hz);
        match (&self.input, &self.output) {
            (FrfInput::BaseAcceleration, FrfOutput::Acceleration(_)) => c64::new(1.0, 0.0),
            (FrfInput::BaseAcceleration, FrfOutput::Velocity(_)) => 1.0 / jw,
            (FrfInput::BaseAcceleration, FrfOutput::Displacement(_)) => 1.0 / (jw * jw),
            _ => c64::new(0.0, 0.0),
        }
    }
}
