//! Frequency responses in the band of a modal analysis.

use jounce_linalg::c64;

use super::ModalError;
use super::band_lines::{BandLines, LeaveOneOutChange, MeasuredResponse, check_lengths};
use super::maximum_likelihood::variance;
use crate::response::MeasuredResponses;
use jounce_data::recording::Quantity;
use jounce_signal::spectral::WindowBias;

/// Ratio of the lowest to the highest frequency of a band that begins far from 0.
const FAR_BAND_RATIO: f64 = 0.25;

/// Measured quantity of the responses, per force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ResponseQuantity {
    /// Displacement.
    Displacement,
    /// Velocity.
    Velocity,
    /// Acceleration.
    #[default]
    Acceleration,
}

/// Responses between two frequencies, as displacement per force.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    pub(super) low_hz: f64,
    pub(super) high_hz: f64,
    /// Frequencies above 0, Hz.
    pub(super) frequency_hz: Vec<f64>,
    /// Displacement per force: response, line.
    pub(super) response: Vec<Vec<c64>>,
    /// Variance of each line of each response, real and imaginary part together; empty if unknown.
    pub(super) variance: Vec<Vec<f64>>,
    /// Noise model.
    pub(super) noise: BandNoise,
    pub(super) inputs: usize,
    /// Bias of the window on a free decay.
    pub(super) window_bias: WindowBias,
    /// Change by leaving out one part of the blocks, for each part.
    pub(super) leave_one_out: Vec<LeaveOneOutChange>,
    /// True where the forces are used as outputs and the sensors as references.
    pub(super) swapped: bool,
    /// Power of `j w` from displacement to the measured quantity of each response.
    pub(super) power: Vec<i32>,
}

/// Noise model of a band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BandNoise {
    /// Unknown, or estimated from blocks.
    Measured,
    /// Equal on all lines.
    Uniform,
    /// The variance of each line is estimated from the residuals of a fit.
    FromResiduals,
}

impl Band {
    /// Selects the lines between two frequencies of responses `response[o * inputs + i]` at
    /// `frequency_hz`. `relative_deviation` refers to `|H|` at each line of each response where
    /// known (from the coherence), and empty otherwise.
    ///
    /// # Errors
    /// Responses of unequal length, a line that is not a number.
    pub fn new(
        frequency_hz: &[f64],
        response: &[Vec<c64>],
        relative_deviation: &[Vec<f64>],
        inputs: usize,
        motion: ResponseQuantity,
        between_hz: (f64, f64),
    ) -> Result<Self, ModalError> {
        // |H| has half of the variance, the phase the other half.
        let line_variance =
            |(deviation, h): (&f64, &c64)| 2.0 * (deviation.max(1e-6) * h.norm()).powi(2);
        let mut measured = Vec::new();
        for (k, value) in response.iter().enumerate() {
            let deviation = relative_deviation.get(k);
            if let Some(lines) = deviation
                .map(Vec::len)
                .filter(|lines| *lines != value.len())
            {
                return Err(ModalError::Lengths {
                    response: k + 1,
                    lines,
                    expected: value.len(),
                });
            }
            let variance =
                deviation.map(|deviation| deviation.iter().zip(value).map(line_variance).collect());
            measured.push(MeasuredResponse {
                value,
                variance,
                power: motion as i32,
                leave_one_out: &[],
                position: 0,
            });
        }
        Self::of_measured(
            frequency_hz,
            &measured,
            inputs,
            WindowBias::Whole,
            between_hz,
        )
    }

    fn of_measured(
        frequency_hz: &[f64],
        measured: &[MeasuredResponse<'_>],
        inputs: usize,
        window_bias: WindowBias,
        (low_hz, high_hz): (f64, f64),
    ) -> Result<Self, ModalError> {
        check_lengths(measured, inputs, frequency_hz.len())?;
        let lines = BandLines::between(frequency_hz, low_hz, high_hz);
        for (o, function) in measured.iter().enumerate() {
            if let Some(frequency_hz) = lines.first_not_finite_hz(function) {
                return Err(ModalError::NotFinite {
                    response: o + 1,
                    frequency_hz,
                });
            }
        }
        let displacement = |function: &MeasuredResponse<'_>| lines.displacement(function);
        Ok(Self {
            low_hz,
            high_hz,
            frequency_hz: lines.frequencies_hz(),
            response: measured.iter().map(displacement).collect(),
            variance: measured
                .iter()
                .filter_map(|function| lines.variance(function))
                .collect(),
            inputs,
            window_bias,
            leave_one_out: lines.leave_one_out(measured),
            noise: BandNoise::Measured,
            swapped: false,
            power: measured.iter().map(|function| function.power).collect(),
        })
    }

    /// Selects the lines between two frequencies of measured responses. For forces at several
    /// locations the references are the sensors where these are fewer, by reciprocity. A voltage is
    /// treated as a displacement, because the voltage of a patch follows its strain; a response
    /// without unit as an acceleration. Responses of several kinds may be combined, and so may
    /// responses to a force, a voltage and the base motion. The inertial force of the base motion
    /// is proportional to its acceleration. An accelerometer on the structure adds 1 to the
    /// response per base acceleration, which the term of the modes below the band absorbs.
    /// Coherence of several blocks weights the lines.
    ///
    /// # Errors
    /// Those of [`Band::new`].
    pub fn of(responses: &MeasuredResponses, between_hz: (f64, f64)) -> Result<Self, ModalError> {
        let first = responses.functions.first();
        let frequency_hz = first.map_or(&[][..], |function| &function.frequency_hz);
        let (functions, quantities) = (&responses.functions, &responses.quantities);
        let is_averaged = functions.iter().all(|function| function.blocks > 1);
        let references = responses.references.len().max(1);
        let swapped = functions.len() < references * references;
        let mut measured = Vec::new();
        for k in order(functions.len(), references, swapped) {
            let (function, power) = (&functions[k], power(quantities[k], responses.inputs[k]));
            let variance = is_averaged.then(|| variance(function));
            measured.push(MeasuredResponse {
                value: &function.value,
                variance,
                power,
                leave_one_out: &function.leave_one_out,
                position: k % references,
            });
        }
        let inputs = if swapped {
            functions.len() / references
        } else {
            references
        };
        let window_bias = first.map_or(WindowBias::Whole, |function| function.window_bias);
        Ok(Self {
            swapped,
            ..Self::of_measured(frequency_hz, &measured, inputs, window_bias, between_hz)?
        })
    }

    /// Reorders values from band order to response order.
    pub(super) fn in_order<T>(&self, values: Vec<T>) -> Vec<T> {
        let mut ordered: Vec<(usize, T)> = order(values.len(), self.outputs(), self.swapped)
            .into_iter()
            .zip(values)
            .collect();
        ordered.sort_by_key(|(k, _)| *k);
        ordered.into_iter().map(|(_, one)| one).collect()
    }

    /// Returns the lines up to a frequency, for the search of poles.
    pub(super) fn up_to(&self, high_hz: f64) -> Self {
        let lines = self.frequency_hz.partition_point(|hz| *hz <= high_hz);
        let truncated = |values: &Vec<c64>| values[..lines].to_vec();
        Self {
            low_hz: self.low_hz,
            high_hz,
            frequency_hz: self.frequency_hz[..lines].to_vec(),
            response: self.response.iter().map(truncated).collect(),
            variance: self
                .variance
                .iter()
                .map(|values| values[..lines].to_vec())
                .collect(),
            noise: self.noise,
            inputs: self.inputs,
            window_bias: self.window_bias,
            leave_one_out: Vec::new(),
            swapped: self.swapped,
            power: self.power.clone(),
        }
    }

    /// Returns the band with variances estimated from the residuals of a fit.
    pub(super) fn with_variance(&self, variance: Vec<Vec<f64>>) -> Self {
        Self {
            variance,
            noise: BandNoise::FromResiduals,
            leave_one_out: Vec::new(),
            ..self.clone()
        }
    }

    /// Returns the band with equal noise on all lines, unless the noise is known.
    pub(super) fn with_uniform_noise(self) -> Self {
        Self {
            noise: BandNoise::Uniform,
            ..self
        }
    }

    /// True where the noise can only be estimated from a fit.
    pub(super) fn has_unknown_noise(&self) -> bool {
        self.variance.is_empty() && self.noise == BandNoise::Measured
    }

    /// Returns a response in its measured quantity.
    pub(super) fn measured(&self, response: usize) -> Vec<c64> {
        self.response[response]
            .iter()
            .enumerate()
            .map(|(k, h)| h * self.as_measured(response, k))
            .collect()
    }

    /// Factor from displacement to the measured quantity of a response, at a line.
    pub(super) fn as_measured(&self, response: usize, line: usize) -> c64 {
        c64::new(0.0, std::f64::consts::TAU * self.frequency_hz[line]).powi(self.power[response])
    }

    /// True where the band begins so high that an order of 40 cannot cover the circle from 0.
    pub(super) fn starts_far_from_zero(&self) -> bool {
        matches!(self.frequency_hz[..], [first, .., last] if first > FAR_BAND_RATIO * last)
    }

    /// Mean line spacing, Hz.
    pub(super) fn line_hz(&self) -> f64 {
        match self.frequency_hz[..] {
            [first, .., last] => (last - first) / (self.frequency_hz.len() - 1) as f64,
            _ => 0.0,
        }
    }

    /// Number of outputs.
    pub(super) fn outputs(&self) -> usize {
        self.response.len() / self.inputs
    }
}

/// Power of `j w` from displacement per force, or per acceleration of the base, to an output per
/// input.
fn power(output: Quantity, input: Quantity) -> i32 {
    let of_output = match output {
        Quantity::Displacement | Quantity::Voltage => ResponseQuantity::Displacement,
        Quantity::Velocity => ResponseQuantity::Velocity,
        _ => ResponseQuantity::Acceleration,
    };
    let of_input = match input {
        Quantity::Displacement => 2,
        Quantity::Velocity => 1,
        _ => 0,
    };
    of_output as i32 + of_input
}

/// Indices of responses `o * references + i`; where these change sides, by references, then by
/// outputs.
fn order(responses: usize, references: usize, swapped: bool) -> Vec<usize> {
    if !swapped {
        return (0..responses).collect();
    }
    (0..references)
        .flat_map(|i| (i..responses).step_by(references))
        .collect()
}
