//! Amplitudes at multiples of the drive frequency, by least squares.

use std::f64::consts::TAU;

use jounce_linalg::{CholeskyFactor, Mat};

use super::samples::sum;
use super::{Samples, SignalError};

/// Line at a multiple of the drive frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrderLine {
    /// Multiple of the drive frequency; 0.5 is half of it.
    pub order: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Peak amplitude, in the unit of the signal.
    pub amplitude_peak: f64,
    /// Phase, rad, of `amplitude_peak * sin(2 pi frequency_hz t + phase_rad)`, `t = 0` at the first
    /// sample; -pi to pi.
    pub phase_rad: f64,
}

/// Order lines of a signal, its mean and the residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Orders {
    /// Constant part, in the unit of the signal.
    pub mean: f64,
    /// Lines in the requested order.
    pub lines: Vec<OrderLine>,
    /// Rms of signal minus fit: nonperiodic parts and other orders.
    pub residual_rms: f64,
}

impl Samples<'_> {
    /// Fits the lines at `orders` times `drive_hz`, for example `&[0.5, 1.0, 1.5, 2.0]`, and the
    /// mean simultaneously.
    ///
    /// Exact for a signal of only these lines, at any position between bins (measured: 1e-14 of the
    /// largest line over 137.3 periods).
    ///
    /// # Errors
    /// An order is at or below 0, at or above half the sample rate, or duplicate, or the record is
    /// shorter than one period of the smallest distance between two lines.
    pub fn orders(&self, drive_hz: f64, orders: &[f64]) -> Result<Orders, SignalError> {
        self.check(drive_hz, orders)?;
        let basis = Basis {
            drive_hz,
            orders,
            rate_hz: self.rate_hz(),
        };
        let solution = basis
            .fit(self.values())
            .ok_or_else(|| self.too_short(smallest_spacing(orders) * drive_hz))?;
        let line = |(i, &order): (usize, &f64)| {
            let (cosine, sine) = (solution[(2 * i + 1, 0)], solution[(2 * i + 2, 0)]);
            OrderLine {
                order,
                frequency_hz: order * drive_hz,
                amplitude_peak: cosine.hypot(sine),
                phase_rad: cosine.atan2(sine),
            }
        };
        let lines = orders.iter().enumerate().map(line).collect();
        Ok(Orders {
            mean: solution[(0, 0)],
            lines,
            residual_rms: basis.residual_rms(self.values(), &solution),
        })
    }

    fn check(&self, drive_hz: f64, orders: &[f64]) -> Result<(), SignalError> {
        let nyquist_hz = self.rate_hz() / 2.0;
        let fits = |order: f64| order * drive_hz > 0.0 && order * drive_hz < nyquist_hz;
        let twice = |i: usize| orders[..i].contains(&orders[i]);
        if let Some(i) = (0..orders.len()).find(|&i| !fits(orders[i]) || twice(i)) {
            return Err(SignalError::Order {
                order: orders[i],
                drive_hz,
                nyquist_hz,
            });
        }
        let spacing_hz = smallest_spacing(orders) * drive_hz;
        // Roundoff may shorten a record of an integer number of periods.
        if self.duration_s() * spacing_hz < 1.0 - 1e-9 {
            Err(self.too_short(spacing_hz))
        } else {
            Ok(())
        }
    }

    fn too_short(&self, spacing_hz: f64) -> SignalError {
        SignalError::Short {
            duration_s: self.duration_s(),
            needed_s: 1.0 / spacing_hz,
        }
    }
}

/// Returns the smallest distance between two orders, including the mean (order 0).
fn smallest_spacing(orders: &[f64]) -> f64 {
    let mut sorted: Vec<_> = std::iter::once(0.0).chain(orders.iter().copied()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .fold(f64::INFINITY, f64::min)
}

/// Basis `1, cos, sin, cos, sin, ...` at the times of the samples.
struct Basis<'a> {
    drive_hz: f64,
    orders: &'a [f64],
    rate_hz: f64,
}

impl Basis<'_> {
    fn at(&self, sample: usize, row: &mut [f64]) {
        row[0] = 1.0;
        for (pair, order) in row[1..].chunks_exact_mut(2).zip(self.orders) {
            // Complete turns are removed before the multiplication by 2 pi, to retain accuracy in
            // long records.
            let turns = order * self.drive_hz * sample as f64 / self.rate_hz;
            (pair[1], pair[0]) = (TAU * turns.fract()).sin_cos();
        }
    }

    /// Solves the normal equations. The columns are nearly orthogonal over a record of at least one
    /// beat, so squaring loses no accuracy.
    fn fit(&self, values: &[f64]) -> Option<Mat<f64>> {
        let size = 2 * self.orders.len() + 1;
        let (mut matrix, mut right) = (Mat::<f64>::zeros(size, size), Mat::<f64>::zeros(size, 1));
        let mut row = vec![0.0; size];
        for (sample, value) in values.iter().enumerate() {
            self.at(sample, &mut row);
            for j in 0..size {
                right[(j, 0)] += row[j] * value;
                (j..size).for_each(|i| matrix[(i, j)] += row[i] * row[j]);
            }
        }
        Some(CholeskyFactor::of(matrix)?.solve(&right))
    }

    fn residual_rms(&self, values: &[f64], solution: &Mat<f64>) -> f64 {
        let mut row = vec![0.0; solution.nrows()];
        let square = |(sample, value): (usize, &f64)| {
            self.at(sample, &mut row);
            let fit: f64 = row
                .iter()
                .enumerate()
                .map(|(i, x)| x * solution[(i, 0)])
                .sum();
            (value - fit).powi(2)
        };
        (sum(values.iter().enumerate().map(square)) / values.len() as f64).sqrt()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    const LINES: [(f64, f64, f64); 4] = [
        (0.5, 0.02, 0.4),
        (1.0, 13.0, -2.0),
        (4.0, 2.13, 3.0),
        (5.5, 1e-6, 1.0),
    ];

    fn record(duration_s: f64) -> Vec<f64> {
        let count = (duration_s * 1536.0) as usize;
        let value = |t: f64| {
            0.7 + LINES
                .iter()
                .map(|(r, a, p)| a * (TAU * r * 13.37 * t + p).sin())
                .sum::<f64>()
        };
        (0..count).map(|i| value(i as f64 / 1536.0)).collect()
    }

    /// Measured: amplitudes 1e-14 of the largest line, residual 4e-14 of it.
    #[test]
    fn lines_off_every_bin_are_found_exactly_half_orders_too() {
        let values = record(10.27);
        let orders = Samples::new(&values, 1536.0)
            .unwrap()
            .orders(13.37, &[0.5, 1.0, 4.0, 5.5])
            .unwrap();
        assert!((orders.mean - 0.7).abs() < 1e-12);
        for (line, (_, amplitude, phase)) in orders.lines.iter().zip(LINES) {
            assert!((line.amplitude_peak - amplitude).abs() < 1e-11, "{line:?}");
            assert!(
                (line.phase_rad - phase).sin().abs() < 1e-11 * 13.0 / amplitude,
                "{line:?}"
            );
        }
        assert!(orders.residual_rms < 1e-11, "{:e}", orders.residual_rms);
    }

    /// Second method: over an integer number of periods the fit equals the DFT at the bins.
    #[test]
    fn over_whole_periods_the_fit_is_the_spectrum() {
        let values: Vec<_> = (0..2000)
            .map(|i| ((i as f64 * TAU / 100.0).sin() * 3.0).exp())
            .collect();
        let samples = Samples::new(&values, 1000.0).unwrap();
        let lines = samples
            .spectrum(super::super::Window::Rectangular)
            .amplitude_peak;
        for line in samples.orders(10.0, &[1.0, 2.0, 3.0, 7.0]).unwrap().lines {
            let bin = (line.order * 20.0) as usize;
            assert!(
                (line.amplitude_peak - lines[bin]).abs() < 1e-12,
                "{line:?} {}",
                lines[bin]
            );
        }
    }

    #[test]
    fn residual_of_the_lines_is_reported() {
        let values: Vec<_> = (0..1000)
            .map(|i| (TAU * 0.013 * i as f64).sin() + 0.1 * (TAU * 0.25 * i as f64).sin())
            .collect();
        let orders = Samples::new(&values, 1.0)
            .unwrap()
            .orders(0.013, &[1.0])
            .unwrap();
        assert!((orders.residual_rms - 0.1 / 2.0_f64.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn indistinguishable_orders_are_errors() {
        let values = record(10.0);
        let samples = Samples::new(&values, 1536.0).unwrap();
        for orders in [&[0.0][..], &[-1.0], &[f64::NAN], &[60.0], &[1.0, 1.0]] {
            assert!(
                matches!(samples.orders(13.0, orders), Err(SignalError::Order { .. })),
                "{orders:?}"
            );
        }
        assert!(matches!(
            samples.orders(f64::NAN, &[1.0]),
            Err(SignalError::Order { .. })
        ));
        assert!(matches!(
            samples.orders(0.1, &[0.5, 1.0]),
            Err(SignalError::Short { .. })
        ));
    }
}
