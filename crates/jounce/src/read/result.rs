//! Result of reading a file.

use jounce_data::read::{ChannelSummary, ModeShape, RecordingSummary};
use jounce_data::recording::{Issue, Over, Quantity, Series as _};
use serde::{Serialize, Serializer};

/// Contents of a file of an instrument, without the samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReadResult {
    /// Recordings, one for each grid of time or frequency.
    pub recordings: Vec<RecordingResult>,
    /// Natural frequencies of the mode shapes, Hz; NaN if missing.
    pub shape_frequencies_hz: Vec<f64>,
    /// Mode shapes.
    pub shapes: Vec<ShapeResult>,
    /// Issues of the complete file.
    pub issues: Vec<Issue>,
}

/// A recording without its samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordingResult {
    /// Name: the file name, with the number of the data set if the file has several.
    pub name: String,
    /// Independent variable, `time` or `frequency`.
    #[serde(serialize_with = "over")]
    pub over: Over,
    /// Number of samples of each channel.
    pub samples: usize,
    /// Samples per second, or per hertz.
    pub rate: f64,
    /// Channels.
    pub channels: Vec<ChannelResult>,
    /// Data-quality issues and conversions.
    pub issues: Vec<Issue>,
    /// One line: what the recording contains and which commands accept it.
    pub verdict: String,
}

/// A channel without its samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChannelResult {
    /// Name.
    pub name: String,
    /// Measured quantity.
    pub quantity: Quantity,
    /// SI unit; the unit of the file for an unknown quantity, empty if not given.
    pub unit: String,
    /// Location of the sensor; empty if not given.
    pub place: String,
    /// Direction of the sensor; empty if not given.
    pub direction: String,
    /// Node and direction of the force of a response function; empty if not given.
    pub reference: String,
    /// True for complex samples.
    pub complex: bool,
    /// Rms of the samples that are numbers, in the unit of the channel.
    pub rms: f64,
    /// Largest magnitude, in the unit of the channel.
    pub peak: f64,
    /// Mean, in the unit of the channel.
    pub mean: f64,
}

/// A mode shape.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShapeResult {
    /// Natural frequency, Hz; NaN if missing.
    pub frequency_hz: f64,
    /// Damping ratio; NaN if missing.
    pub damping_ratio: f64,
    /// Modal mass of a normal mode, in units of the file; NaN if missing.
    pub modal_mass: f64,
    /// Node numbers.
    pub nodes: Vec<i64>,
    /// Real part of each component at each node.
    pub real: Vec<Vec<f64>>,
    /// Imaginary parts of a complex shape.
    pub imaginary: Option<Vec<Vec<f64>>>,
}

impl RecordingResult {
    pub(super) fn of(recording: &RecordingSummary) -> Self {
        Self {
            name: recording.name.clone(),
            over: recording.over,
            samples: recording.places.count(),
            rate: recording.rate(),
            channels: recording.channels.iter().map(ChannelResult::of).collect(),
            issues: recording.issues.clone(),
            verdict: recording.verdict(),
        }
    }
}

impl ChannelResult {
    fn of(channel: &ChannelSummary) -> Self {
        Self {
            name: channel.name.clone(),
            quantity: channel.quantity,
            unit: channel.unit.clone(),
            place: channel.place.clone(),
            direction: channel.direction.clone(),
            reference: channel.reference.clone(),
            complex: channel.imaginary.is_some(),
            rms: channel.sizes.rms,
            peak: channel.sizes.peak,
            mean: channel.sizes.mean,
        }
    }
}

impl ShapeResult {
    pub(super) fn of(shape: &ModeShape) -> Self {
        let ModeShape {
            frequency_hz,
            damping_ratio,
            modal_mass,
            nodes,
            real,
            imaginary,
        } = shape.clone();
        Self {
            frequency_hz,
            damping_ratio,
            modal_mass,
            nodes,
            real,
            imaginary,
        }
    }
}

fn over<S: Serializer>(over: &Over, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(match over {
        Over::Time => "time",
        Over::Frequency => "frequency",
    })
}
