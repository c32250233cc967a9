//! Result of the frequency responses of a hammer or shaker test.

use jounce_data::recording::Issue;
use jounce_identification::response::MeasuredResponses;
use jounce_signal::spectral::ImpactHit;
use serde::{Serialize, Serializer};

/// Frequency responses of a hammer or shaker test, in the sign convention `exp(+i w t)`.
#[derive(Debug, Clone, Serialize)]
pub struct MeasuredFrfResult {
    /// Frequencies of the lines, Hz.
    pub frequency_hz: Vec<f64>,
    /// Response functions, in JSON by name.
    #[serde(serialize_with = "by_name")]
    pub responses: Vec<MeasuredResponse>,
    /// Channel of the input; empty for given response functions.
    pub input: String,
    /// Names of the sensors.
    pub outputs: Vec<String>,
    /// Excitation points, or the channel of the force without points; empty for given response
    /// functions without names.
    pub references: Vec<String>,
    /// Hits; empty for a shaker and for given response functions.
    pub hits: Vec<ImpactHit>,
    /// Length of a block, s; `None` for given response functions.
    pub block_s: Option<f64>,
    /// Damping that the exponential window adds to every mode, 1/s.
    pub window_decay_per_s: f64,
    /// Data-quality issues of the recordings, and the corrections made.
    pub issues: Vec<Issue>,
    /// The responses in the form of the computations.
    #[serde(skip)]
    pub(crate) data: MeasuredResponses,
}

/// Response function of a sensor to an input.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredResponse {
    /// Name: the sensor, with the excitation point if there are several.
    #[serde(skip)]
    pub name: String,
    /// Real part at each line, in the unit.
    pub re: Vec<f64>,
    /// Imaginary part at each line, in the unit.
    pub im: Vec<f64>,
    /// Unit of the sensor per unit of the input.
    pub unit: String,
    /// Conversion of responses to an acceleration.
    pub per_g: Option<PerG>,
    /// True where sensor and input have the same unit.
    pub transmissibility: bool,
    /// Coherence at each line; 1 for a single block.
    pub coherence: Vec<f64>,
    /// Name of the sensor.
    pub output: String,
    /// Excitation point.
    pub reference: Option<String>,
}

/// Response per g instead of per m/s^2.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PerG {
    /// Factor of the response.
    pub factor: f64,
    /// Unit of the response times the factor.
    pub unit: String,
}

impl MeasuredFrfResult {
    pub(super) fn of(data: MeasuredResponses) -> Self {
        let responses = 0..data.functions.len();
        let frequency_hz = data.functions.first();
        Self {
            frequency_hz: frequency_hz.map_or_else(Vec::new, |first| first.frequency_hz.clone()),
            responses: responses.map(|k| MeasuredResponse::of(&data, k)).collect(),
            input: data.input.clone(),
            outputs: data.outputs.clone(),
            references: data.references.clone(),
            hits: data.hits.clone(),
            block_s: data.block_s,
            window_decay_per_s: data.window_decay_per_s,
            issues: data.issues.clone(),
            data,
        }
    }

    /// Returns the issues of the channels in use and of the recordings.
    pub fn used_issues(&self) -> impl Iterator<Item = &Issue> {
        // Given response functions are all used.
        let is_used = |name: &String| {
            self.block_s.is_none() || self.input == *name || self.outputs.contains(name)
        };
        let is_relevant = move |issue: &&Issue| issue.channel.as_ref().is_none_or(is_used);
        self.issues.iter().filter(is_relevant)
    }
}

impl MeasuredResponse {
    fn of(data: &MeasuredResponses, number: usize) -> Self {
        let references = data.references.len().max(1);
        let function = &data.functions[number];
        let (re, im) = function.value.iter().map(|h| (h.re, h.im)).unzip();
        let per_g = data.per_g(number);
        Self {
            name: data.names[number].clone(),
            re,
            im,
            unit: data.units[number].clone(),
            per_g: per_g.map(|(factor, unit)| PerG { factor, unit }),
            transmissibility: data.is_transmissibility(number),
            coherence: function.coherence.clone(),
            output: data.outputs[number / references].clone(),
            reference: data.references.get(number % references).cloned(),
        }
    }
}

fn by_name<S: Serializer>(all: &[MeasuredResponse], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(all.iter().map(|response| (&response.name, response)))
}
