//! Power spectral density by Welch's method.

use crate::Samples;
use jounce_control::Control;

use super::Segments;
use crate::spectral::SpectralError;

/// One-sided power spectral density: its integral over frequency is the variance.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// Frequency of each line, Hz.
    pub frequency_hz: Vec<f64>,
    /// Density at each line, unit^2/Hz.
    pub density: Vec<f64>,
    /// Number of segments averaged.
    pub segments: usize,
    /// Line spacing, Hz.
    pub resolution_hz: f64,
    /// Mean of the complete record, subtracted before.
    pub mean: f64,
}

/// Unit of the density of a quantity with unit: `V^2/Hz`, `(m/s^2)^2/Hz`, `1/Hz`.
pub fn density_unit(unit: &str) -> String {
    match unit {
        "" => "1/Hz".to_owned(),
        unit if unit.chars().all(char::is_alphabetic) => format!("{unit}^2/Hz"),
        unit => format!("({unit})^2/Hz"),
    }
}

impl Density {
    /// Computes `S(f_k) = c_k / (r sum w^2) mean |X_k|^2`, `c_k = 2` but 1 at zero and half the
    /// rate, after subtracting the mean of the record, with a cancellation check before each
    /// segment.
    ///
    /// # Errors
    /// A segment longer than the record, and [`SpectralError::Stopped`].
    pub fn welch(
        samples: &Samples<'_>,
        segments: &Segments,
        control: &Control,
    ) -> Result<Self, SpectralError> {
        let mean = samples.mean();
        let frequency_hz = segments.frequency_hz(samples.rate_hz());
        let (mut sum, mut count) = (vec![0.0; frequency_hz.len()], 0);
        for start in segments.starts(samples.values().len())? {
            if control.is_stopped() {
                return Err(SpectralError::Stopped);
            }
            let bins = segments.transform(samples, start, mean);
            sum.iter_mut()
                .zip(&bins)
                .for_each(|(sum, bin)| *sum += bin.norm_sqr());
            count += 1;
        }
        let scale = 1.0 / (samples.rate_hz() * segments.power() * f64::from(count));
        let density = sum
            .iter()
            .enumerate()
            .map(|(k, sum)| segments.side_count(k) * sum * scale)
            .collect();
        let resolution_hz = samples.rate_hz() / segments.length() as f64;
        Ok(Self {
            frequency_hz,
            density,
            segments: count as usize,
            resolution_hz,
            mean,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::{RandomStream, Window};
    use jounce_fft::Complex;
    use std::f64::consts::TAU;

    fn noise(count: usize, seed: u64) -> Vec<f64> {
        let mut stream = RandomStream::new(seed, 0);
        (0..count / 2).flat_map(|_| stream.normal_pair()).collect()
    }

    fn density(samples: &Samples<'_>, length: usize) -> Result<Density, SpectralError> {
        let segments = Segments::new(length, 0.5, Window::Hann)?;
        Density::welch(samples, &segments, &Control::default())
    }

    /// White noise of variance 1 at r Hz has the density 2/r; measured with 511 segments: 0.2 % low on average, and the integral is the variance
    /// to 3.3e-4.
    #[test]
    fn white_noise_is_flat_at_its_known_density() {
        let values = noise(1 << 17, 3);
        let samples = Samples::new(&values, 1000.0).unwrap();
        let density = density(&samples, 512).unwrap();
        let mean = density.density[2..255].iter().sum::<f64>() / 253.0;
        assert!((mean / 2e-3 - 1.0).abs() < 0.01, "{mean}");
        let max_error = density.density[2..255]
            .iter()
            .map(|s| (s / 2e-3 - 1.0).abs())
            .fold(0.0, f64::max);
        // Relative deviation of a line: about 1/sqrt(511 * 18/19 ..); five of them.
        assert!(max_error < 0.3, "{max_error}");
        let variance = density.density.iter().sum::<f64>() * density.resolution_hz;
        assert!((variance - samples.rms().powi(2)).abs() < 0.01);
    }

    /// A first-order recursion has a density in closed form; measured 3.1 % rms over 1023 segments, 1/sqrt(1023) = 3.1 %.
    #[test]
    fn coloured_noise_has_the_density_of_its_filter() {
        let white = noise(1 << 18, 5);
        let mut state = 0.0;
        let coloured: Vec<f64> = white
            .iter()
            .map(|x| {
                state = 0.9 * state + x;
                state
            })
            .collect();
        let density = density(&Samples::new(&coloured, 1.0).unwrap(), 512).unwrap();
        let exact_density = |f: f64| {
            2.0 / (Complex::new(1.0, 0.0) - 0.9 * Complex::from_polar(1.0, -TAU * f)).norm_sqr()
        };
        let errors: Vec<f64> = (4..250)
            .map(|k| density.density[k] / exact_density(density.frequency_hz[k]) - 1.0)
            .collect();
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        assert!(rms < 0.05, "{rms}");
    }

    #[test]
    fn units_of_densities_have_brackets_where_they_need_them() {
        for (unit, density) in [("V", "V^2/Hz"), ("m/s^2", "(m/s^2)^2/Hz"), ("", "1/Hz")] {
            assert_eq!(density_unit(unit), density);
        }
    }

    #[test]
    fn segments_that_do_not_fit_are_errors() {
        assert!(matches!(
            Segments::new(4, 0.5, Window::Hann),
            Err(SpectralError::Few { samples: 4 })
        ));
        assert!(matches!(
            Segments::new(64, 1.0, Window::Hann),
            Err(SpectralError::Overlap { .. })
        ));
        let values = vec![1.0; 63];
        let samples = Samples::new(&values, 1.0).unwrap();
        assert!(matches!(
            density(&samples, 64),
            Err(SpectralError::Segment { samples: 63, .. })
        ));
        let control = Control::default();
        control.stop();
        let stopped = Density::welch(
            &samples,
            &Segments::new(32, 0.5, Window::Hann).unwrap(),
            &control,
        );
        assert_eq!(stopped, Err(SpectralError::Stopped));
    }
}
