//! Uniformly sampled signals: mean, rms and peak.

use super::SignalError;

/// Finite samples at a fixed rate, at least one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples<'a> {
    values: &'a [f64],
    rate_hz: f64,
}

impl<'a> Samples<'a> {
    /// Creates a signal from `values` sampled every `1 / rate_hz` seconds.
    ///
    /// # Errors
    /// The signal is empty, a sample is not finite, or the rate is not positive.
    pub fn new(values: &'a [f64], rate_hz: f64) -> Result<Self, SignalError> {
        if values.is_empty() {
            return Err(SignalError::Empty);
        }
        if !(rate_hz > 0.0 && rate_hz.is_finite()) {
            return Err(SignalError::Rate { rate_hz });
        }
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(SignalError::Sample {
                index,
                value: values[index],
            });
        }
        Ok(Self { values, rate_hz })
    }

    /// Returns the samples.
    pub fn values(&self) -> &'a [f64] {
        self.values
    }

    /// Returns the sample rate, Hz.
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Returns the length of the record, s: number of samples over rate.
    pub fn duration_s(&self) -> f64 {
        self.values.len() as f64 / self.rate_hz
    }

    /// Returns `sum x / N`.
    pub fn mean(&self) -> f64 {
        sum(self.values.iter().copied()) / self.values.len() as f64
    }

    /// Returns `sqrt(sum x^2 / N)`, including the mean.
    pub fn rms(&self) -> f64 {
        // Scaled by the peak, so that squares neither overflow nor underflow.
        let peak = self.peak();
        if peak == 0.0 {
            return 0.0;
        }
        peak * (sum(self.values.iter().map(|x| (x / peak).powi(2))) / self.values.len() as f64)
            .sqrt()
    }

    /// Returns `max |x|`.
    pub fn peak(&self) -> f64 {
        self.values.iter().fold(0.0, |peak, x| peak.max(x.abs()))
    }
}

/// Computes a compensated sum (Neumaier 1974): the error does not grow with the number of terms.
pub(super) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut compensation) = (0.0_f64, 0.0);
    for term in terms {
        let next = sum + term;
        compensation += if sum.abs() >= term.abs() {
            (sum - next) + term
        } else {
            (term - next) + sum
        };
        sum = next;
    }
    sum + compensation
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn measures_of_a_sine_on_an_offset() {
        let values: Vec<_> = (0..1000)
            .map(|i| 0.5 + 3.0 * (std::f64::consts::TAU * 7.0 * f64::from(i) / 1000.0).sin())
            .collect();
        let samples = Samples::new(&values, 1000.0).unwrap();
        assert!(
            (samples.mean() - 0.5).abs() < 1e-15,
            "measured {:e}",
            samples.mean() - 0.5
        );
        assert!((samples.rms() - (0.25_f64 + 4.5).sqrt()).abs() < 1e-15);
        assert!((samples.peak() - 3.5).abs() < 1e-4);
        assert!((samples.duration_s() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn large_small_and_cancelling_values_are_measured_exactly() {
        assert_eq!(Samples::new(&[1e300, -1e300], 1.0).unwrap().rms(), 1e300);
        assert_eq!(Samples::new(&[1e-300, -1e-300], 1.0).unwrap().rms(), 1e-300);
        assert_eq!(Samples::new(&[0.0], 1.0).unwrap().rms(), 0.0);
        assert_eq!(
            Samples::new(&[1e16, 3.0, -1e16, 1.0], 1.0).unwrap().mean(),
            1.0
        );
    }

    #[test]
    fn invalid_signals_are_errors() {
        assert_eq!(Samples::new(&[], 1.0), Err(SignalError::Empty));
        assert!(matches!(
            Samples::new(&[1.0, f64::NAN], 1.0),
            Err(SignalError::Sample { index: 1, .. })
        ));
        for rate_hz in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Samples::new(&[1.0], rate_hz),
                Err(SignalError::Rate { .. })
            ));
        }
    }
}
