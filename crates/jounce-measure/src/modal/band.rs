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
    /// True where the forces stand for the outputs and the sensors for the references.
    pub(super) swapped: bool,
    /// Power of `j w` from displacement to what each response measures.
    power: Vec<i32>,
}

/// What one response measures, at each line.
struct Measured<'a> {
    value: &'a [c64],
    relative_deviation: Option<&'a [f64]>,
    motion: Motion,
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
        let deviation = |k: usize| relative_deviation.get(k).map(Vec::as_slice);
        let measured: Vec<Measured<'_>> =
            response.iter().enumerate().map(|(k, value)| Measured { value, relative_deviation: deviation(k), motion }).collect();
        Self::of_measured(frequency_hz, &measured, inputs, between_hz)
    }

    fn of_measured(
        frequency_hz: &[f64],
        measured: &[Measured<'_>],
        inputs: usize,
        (low_hz, high_hz): (f64, f64),
    ) -> Result<Self, ModalError> {
        let expected = frequency_hz.len();
        if measured.is_empty() || inputs == 0 || !measured.len().is_multiple_of(inputs.max(1)) {
            return Err(ModalError::Lengths { response: measured.len(), lines: 0, expected });
        }
        for (k, one) in measured.iter().enumerate() {
            let lengths = [one.value.len(), one.relative_deviation.map_or(expected, <[f64]>::len)];
            if let Some(lines) = lengths.into_iter().find(|lines| *lines != expected) {
                return Err(ModalError::Lengths { response: k + 1, lines, expected });
            }
        }
        let inside: Vec<usize> =
            (0..expected).filter(|k| frequency_hz[*k] > 0.0 && (low_hz..=high_hz).contains(&frequency_hz[*k])).collect();
        for (o, one) in measured.iter().enumerate() {
            if let Some(k) = inside.iter().find(|k| !(one.value[**k].re.is_finite() && one.value[**k].im.is_finite())) {
                return Err(ModalError::NotFinite { response: o + 1, frequency_hz: frequency_hz[*k] });
            }
        }
        let at =
            |one: &Measured<'_>, k: usize| one.value[k] * c64::new(0.0, std::f64::consts::TAU * frequency_hz[k]).powi(-(one.motion as i32));
        let displacement = |one: &Measured<'_>| inside.iter().map(|k| at(one, *k)).collect::<Vec<c64>>();
        let variance = |one: &Measured<'_>| -> Option<Vec<f64>> {
            let deviation = one.relative_deviation?;
            // |H| takes half of the variance, the phase the other half.
            Some(inside.iter().map(|k| 2.0 * (deviation[*k].max(1e-6) * at(one, *k).norm()).powi(2)).collect())
        };
        Ok(Self {
            low_hz,
            high_hz,
            frequency_hz: inside.iter().map(|k| frequency_hz[*k]).collect(),
            response: measured.iter().map(displacement).collect(),
            variance: measured.iter().filter_map(variance).collect(),
            inputs,
            swapped: false,
            power: measured.iter().map(|one| one.motion as i32).collect(),
        })
    }

    /// The lines between two frequencies of measured responses. Of forces at several places the references are the sensors where these are
    /// fewer: a structure answers alike when force and sensor change places. What measures a voltage is taken for a displacement, since that of
    /// a patch follows its strain; what tells no unit for an acceleration. Responses of several kinds may stand together. Coherence of several
    /// blocks weighs the lines.
    ///
    /// # Errors
    /// As [`Band::new`].
    pub fn of(responses: &Responses, between_hz: (f64, f64)) -> Result<Self, ModalError> {
        let motion = |quantity: Quantity| match quantity {
            Quantity::Displacement | Quantity::Voltage => Motion::Displacement,
            Quantity::Velocity => Motion::Velocity,
            _ => Motion::Acceleration,
        };
        let first = responses.functions.first();
        let frequency_hz = first.map_or(&[][..], |function| &function.frequency_hz);
        let several = responses.functions.iter().all(|function| function.blocks > 1);
        let deviation = |function: &FrequencyResponse| (0..function.value.len()).map(|k| function.relative_deviation(k)).collect();
        let deviation: Vec<Vec<f64>> = responses.functions.iter().filter(|_| several).map(deviation).collect();
        let references = responses.references.len().max(1);
        let swapped = responses.functions.len() < references * references;
        let (functions, quantities) = (&responses.functions, &responses.quantities);
        let measured = order(functions.len(), references, swapped).into_iter().map(|k| Measured {
            value: &functions[k].value,
            relative_deviation: deviation.get(k).map(Vec::as_slice),
            motion: motion(quantities[k]),
        });
        let inputs = if swapped { functions.len() / references } else { references };
        Ok(Self { swapped, ..Self::of_measured(frequency_hz, &measured.collect::<Vec<_>>(), inputs, between_hz)? })
    }

    /// What stands in the order of the band in that of the responses.
    pub(super) fn in_order<T>(&self, of: Vec<T>) -> Vec<T> {
        let mut placed: Vec<(usize, T)> = order(of.len(), self.outputs(), self.swapped).into_iter().zip(of).collect();
        placed.sort_by_key(|(k, _)| *k);
        placed.into_iter().map(|(_, one)| one).collect()
    }

    /// The lines up to a frequency.
    pub(super) fn below(&self, high_hz: f64) -> Self {
        let lines = self.frequency_hz.partition_point(|hz| *hz <= high_hz);
        let cut = |of: &Vec<c64>| of[..lines].to_vec();
        Self {
            low_hz: self.low_hz,
            high_hz,
            frequency_hz: self.frequency_hz[..lines].to_vec(),
            response: self.response.iter().map(cut).collect(),
            variance: self.variance.iter().map(|of| of[..lines].to_vec()).collect(),
            inputs: self.inputs,
            swapped: self.swapped,
            power: self.power.clone(),
        }
    }

    /// A response as it was measured.
    pub(super) fn measured(&self, response: usize) -> Vec<c64> {
        self.response[response].iter().enumerate().map(|(k, h)| h * self.as_measured(response, k)).collect()
    }

    /// Factor from displacement to what a response measures, at a line.
    pub(super) fn as_measured(&self, response: usize, line: usize) -> c64 {
        c64::new(0.0, std::f64::consts::TAU * self.frequency_hz[line]).powi(self.power[response])
    }

    /// Mean distance of two lines, Hz.
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

/// Numbers of responses `o * references + i`: by their references, then by their outputs, where these change sides.
fn order(responses: usize, references: usize, swapped: bool) -> Vec<usize> {
    if !swapped {
        return (0..responses).collect();
    }
    (0..references).flat_map(|i| (i..responses).step_by(references)).collect()
}
