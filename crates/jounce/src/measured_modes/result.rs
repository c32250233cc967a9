//! Result of the identification of modes from measurements.

use crate::measured_frf::MeasuredFrfResult;
use jounce_data::recording::Issue;
use jounce_identification::modal::{Identification, Mode, Participation, ResponsePeak, StablePole};
use jounce_signal::spectral::ImpactHit;
use serde::Serialize;

/// Modes of a hammer or shaker test, of free decays or of outputs only.
#[derive(Debug, Clone, Serialize)]
pub struct MeasuredModesResult {
    /// Modes in ascending frequency.
    pub modes: Vec<MeasuredMode>,
    /// Points of the shapes.
    pub responses: Vec<String>,
    /// Excitation points, if there are several.
    pub references: Vec<String>,
    /// Modal assurance criterion of each pair of modes.
    pub mac: Vec<Vec<f64>>,
    /// Squared error over the variance from the coherence; above 1 the deviations are multiplied by
    /// its root.
    pub misfit: f64,
    /// Peaks of the responses that no mode explains.
    pub unexplained: Vec<ResponsePeak>,
    /// Poles of the stabilisation diagram.
    pub stabilisation: Vec<StablePole>,
    /// Hits of a hammer test.
    pub hits: Vec<ImpactHit>,
    /// Length of a block, s; `None` without a hammer or shaker.
    pub block_s: Option<f64>,
    /// Damping of the exponential window, which was subtracted, 1/s.
    pub window_decay_per_s: f64,
    /// Data-quality issues of the recordings, and the corrections made.
    pub issues: Vec<Issue>,
    /// Names of the functions that the modes were identified from: responses, or decays, one or
    /// more for each point.
    #[serde(skip)]
    pub functions: Vec<String>,
    /// Responses of a hammer or shaker test.
    #[serde(skip)]
    pub frf: Option<MeasuredFrfResult>,
    /// The functions of the band, measured and reconstructed from the modes.
    #[serde(skip)]
    pub identification: Identification,
    /// Channels in use of a test without an input.
    #[serde(skip)]
    pub(super) used_channels: Vec<String>,
}

/// A mode.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredMode {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Standard deviation of the frequency, Hz.
    pub frequency_deviation_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Standard deviation of the damping ratio.
    pub damping_deviation: f64,
    /// Half width of the 95 % interval, in standard deviations.
    pub quantile_95: f64,
    /// True where the interval of the damping ratio includes 0: the mode may be noise.
    pub doubtful: bool,
    /// Shape at each point, 1 at the largest.
    pub shape: ComplexValues,
    /// Participation of each excitation point, 1 at the largest.
    pub participation: ComplexValues,
    /// Shape at each point times the participation of the base whose motion is the input; `None`
    /// for another input.
    pub base_participation: Option<Vec<Participation>>,
}

/// Complex numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComplexValues {
    /// Real parts.
    pub re: Vec<f64>,
    /// Imaginary parts.
    pub im: Vec<f64>,
}

impl MeasuredMode {
    pub(super) fn of(mode: &Mode, references: usize, frf: Option<&MeasuredFrfResult>) -> Self {
        let shape = mode.shape();
        let participation = mode.participation.iter().take(references);
        Self {
            frequency_hz: mode.frequency_hz,
            frequency_deviation_hz: mode.frequency_deviation_hz,
            damping_ratio: mode.damping_ratio,
            damping_deviation: mode.damping_deviation,
            quantile_95: mode.quantile_95,
            doubtful: mode.is_doubtful(),
            shape: ComplexValues::of(shape.iter().map(|one| (one.re, one.im))),
            participation: ComplexValues::of(participation.map(|one| (one.re, one.im))),
            base_participation: frf.and_then(|frf| mode.base_participation(&frf.data)),
        }
    }

    /// Returns the half width of the 95 % interval of the frequency, Hz.
    pub fn frequency_half_width_hz(&self) -> f64 {
        self.quantile_95 * self.frequency_deviation_hz
    }

    /// Returns the half width of the 95 % interval of the damping ratio.
    pub fn damping_half_width(&self) -> f64 {
        self.quantile_95 * self.damping_deviation
    }
}

impl ComplexValues {
    fn of(values: impl Iterator<Item = (f64, f64)>) -> Self {
        let (re, im) = values.unzip();
        Self { re, im }
    }
}

impl MeasuredModesResult {
    /// Returns the issues of the channels in use and of the recordings.
    pub fn used_issues(&self) -> Vec<&Issue> {
        match &self.frf {
            Some(frf) => frf.used_issues().collect(),
            None => {
                let is_used = |name: &String| self.used_channels.contains(name);
                let is_relevant = |issue: &&Issue| issue.channel.as_ref().is_none_or(is_used);
                self.issues.iter().filter(is_relevant).collect()
            }
        }
    }
}
