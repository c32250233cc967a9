//! Frequency responses in the band that modes are sought in.

use faer::c64;

use super::ModalError;
use crate::recording::Quantity;
use crate::response::Responses;
use crate::spectral::FrequencyResponse;

/// What the responses measure, per force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Motion {
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
    /// Variance of each line of each response, real and imaginary part together; empty where nothing is told.
    pub(super) variance: Vec<Vec<f64>>,
    pub(super) inputs: usize,
    /// Power of `j w` from displacement to what was measured.
    power: i32,
}

impl Band {
    /// The lines between two frequencies of responses `response[o * inputs + i]` at `frequency_hz`. `relative_deviation` is that of `|H|` at
    /// each line of each response where it is known (from the coherence), and empty where it is not.
    ///
    /// # Errors
    /// Responses of unequal length, a line that is not a number.
    pub fn new(
        frequency_hz: &[f64],
        response: &[Vec<c64>],
        relative_deviation: &[Vec<f64>],
        inputs: usize,
        motion: Motion,
        between_hz: (f64, f64),
    ) -> Result<Self, ModalError> {
        let expected = frequency_hz.len();
        if response.is_empty() || inputs == 0 || !response.len().is_multiple_of(inputs.max(1)) {
            return Err(ModalError::Lengths { response: response.len(), lines: 0, expected });
        }
        let unequal = |lengths: Vec<usize>| lengths.into_iter().enumerate().find(|(_, lines)| *lines != expected);
        let lengths = response.iter().map(Vec::len).collect();
        let deviations = relative_deviation.iter().map(Vec::len).collect();
        if let Some((k, lines)) = unequal(lengths).or_else(|| unequal(deviations)) {
            return Err(ModalError::Lengths { response: k + 1, lines, expected });
        }
        let (low_hz, high_hz) = between_hz;
        let inside: Vec<usize> =
            (0..expected).filter(|k| frequency_hz[*k] > 0.0 && (low_hz..=high_hz).contains(&frequency_hz[*k])).collect();
        for (o, response) in response.iter().enumerate() {
            if let Some(k) = inside.iter().find(|k| !(response[**k].re.is_finite() && response[**k].im.is_finite())) {
                return Err(ModalError::NotFinite { response: o + 1, frequency_hz: frequency_hz[*k] });
            }
        }
        let power = motion as i32;
        let factor = |k: usize| c64::new(0.0, std::f64::consts::TAU * frequency_hz[k]).powi(-power);
        let displacement = |h: &Vec<c64>| inside.iter().map(|k| h[*k] * factor(*k)).collect::<Vec<c64>>();
        let variance = |(h, deviation): (&Vec<c64>, &Vec<f64>)| -> Vec<f64> {
            // |H| takes half of the variance, the phase the other half.
            inside.iter().map(|k| 2.0 * (deviation[*k].max(1e-6) * (h[*k] * factor(*k)).norm()).powi(2)).collect()
        };
        Ok(Self {
            low_hz,
            high_hz,
            frequency_hz: inside.iter().map(|k| frequency_hz[*k]).collect(),
            response: response.iter().map(displacement).collect(),
            variance: response.iter().zip(relative_deviation).map(variance).collect(),
            inputs,
            power,
        })
    }

    /// The lines between two frequencies of measured responses to one force. What measures a voltage is taken for a displacement, since that of
    /// a patch follows its strain; what tells no unit for an acceleration. Coherence of several blocks weighs the lines.
    ///
    /// # Errors
    /// As [`Band::new`].
    pub fn of(responses: &Responses, between_hz: (f64, f64)) -> Result<Self, ModalError> {
        let motion = match responses.quantity {
            Quantity::Displacement | Quantity::Voltage => Motion::Displacement,
            Quantity::Velocity => Motion::Velocity,
            _ => Motion::Acceleration,
        };
        let first = responses.functions.first();
        let frequency_hz = first.map_or(&[][..], |function| &function.frequency_hz);
        let value: Vec<Vec<c64>> = responses.functions.iter().map(|function| function.value.clone()).collect();
        let several = first.is_some_and(|function| function.blocks > 1);
        let deviation = |function: &FrequencyResponse| (0..function.value.len()).map(|k| function.relative_deviation(k)).collect();
        let deviation: Vec<Vec<f64>> = responses.functions.iter().filter(|_| several).map(deviation).collect();
        Self::new(frequency_hz, &value, &deviation, 1, motion, between_hz)
    }

    /// A response as it was measured.
    pub(super) fn measured(&self, response: usize) -> Vec<c64> {
        let line = |(h, f): (&c64, &f64)| h * c64::new(0.0, std::f64::consts::TAU * f).powi(self.power);
        self.response[response].iter().zip(&self.frequency_hz).map(line).collect()
    }

    /// Number of outputs.
    pub(super) fn outputs(&self) -> usize {
        self.response.len() / self.inputs
    }
}
