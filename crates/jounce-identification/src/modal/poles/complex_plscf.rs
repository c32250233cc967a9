//! Poles in a band that begins far from 0, by pLSCF with complex coefficients.
//!
//! Relative to the lower end `f_0` of the band, the responses are not those of a real system,
//! because the conjugate poles lie below it. They are therefore not mirrored:
//!
//! ```text
//! H_o(w) = B_o(z) A(z)^-1,   z = exp(-j (w - 2 pi f_0) T),   p = -ln(z) / T + j 2 pi f_0
//! ```
//!
//! with complex coefficients and `T` such that the lines cover the circle once. Uniform lines make
//! `R = X^H X` a multiple of the identity, however far from 0 the band is. Modes outside the band,
//! including conjugate ones, are smooth in it and are absorbed by `B`.
use jounce_linalg::{Mat, c64, complex_inverse_cholesky_factor};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::Pole;
use super::sums::{fourier_sums, signals};
use crate::modal::{Band, ModalError};

/// Sums over the lines, shared by all orders.
struct ComplexMoments {
    inputs: usize,
    /// `sum z^k` for k from `-max_order` to `max_order`.
    r: Vec<c64>,
    /// `sum z^k H_o`: output, input, k.
    s: Vec<Vec<Vec<c64>>>,
    /// `sum z^k conj(H_oi) H_oj`, summed over outputs: i, j, k.
    t: Vec<Vec<Vec<c64>>>,
    max_order: usize,
    interval_s: f64,
    base_hz: f64,
}

/// Poles above the lower end of the band for each order from 1 to `max_order`, in ascending
/// frequency, without unstable ones. An order with singular equations is empty.
///
/// # Errors
/// Responses that are all zero.
pub(super) fn poles(band: &Band, max_order: usize) -> Result<Vec<Vec<Pole>>, ModalError> {
    let moments = ComplexMoments::of(band, max_order);
    let normal = moments.normal()?;
    let result: Vec<Option<Vec<Pole>>> =
        normal.into_par_iter().map(|m| moments.poles(&m)).collect();
    if result.iter().all(Option::is_none) {
        return Err(ModalError::Singular { order: max_order });
    }
    Ok(result.into_iter().map(Option::unwrap_or_default).collect())
}

impl ComplexMoments {
    fn of(band: &Band, max_order: usize) -> Self {
        let (inputs, outputs) = (band.inputs, band.outputs());
        let base_hz = band
            .frequency_hz
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        let highest_hz = band.frequency_hz.iter().copied().fold(0.0, f64::max);
        let interval_s = 1.0 / (highest_hz - base_hz + band.line_hz());
        let phasors: Vec<c64> = band
            .frequency_hz
            .iter()
            .map(|f| c64::from_polar(1.0, -TAU * (f - base_hz) * interval_s))
            .collect();
        // The real part of a signal times -j is the imaginary part of the signal.
        let signals: Vec<Vec<c64>> = signals(band)
            .into_iter()
            .flat_map(|h| [h.iter().map(|x| c64::new(x.im, -x.re)).collect(), h])
            .collect();
        let sums = fourier_sums(&phasors, &signals, max_order);
        let joined = |pair: &[Vec<f64>]| -> Vec<c64> {
            pair[1]
                .iter()
                .zip(&pair[0])
                .map(|(re, im)| c64::new(*re, *im))
                .collect()
        };
        let mut sums = sums.chunks(2).map(joined);
        let mut rows = |count: usize| -> Vec<Vec<Vec<c64>>> {
            (0..count)
                .map(|_| sums.by_ref().take(inputs).collect())
                .collect()
        };
        let (s, t) = (rows(outputs), rows(inputs));
        let r = sums.next().unwrap_or_default();
        Self {
            inputs,
            r,
            s,
            t,
            max_order,
            interval_s,
            base_hz,
        }
    }

    /// Matrix `M` of each order from 1, up to the first singular `R`.
    fn normal(&self) -> Result<Vec<Mat<c64>>, ModalError> {
        let (n, width) = (self.inputs, self.max_order + 1);
        let index = |a: usize, b: usize| self.max_order + b - a;
        let r = Mat::from_fn(width, width, |a, b| self.r[index(a, b)]);
        let inverse = complex_inverse_cholesky_factor(&r).ok_or(ModalError::Singular {
            order: self.max_order,
        })?;
        let y: Vec<Mat<c64>> = self
            .s
            .par_iter()
            .map(|s| &inverse * Mat::from_fn(width, n * width, |a, b| -s[b % n][index(a, b / n)]))
            .collect();
        let mut eliminated = Mat::<c64>::zeros(n * width, n * width);
        let mut matrices = Vec::new();
        for order in 0..width {
            let row = Mat::from_fn(y.len(), n * width, |o, b| y[o][(order, b)]);
            eliminated += row.adjoint() * &row;
            let column_count = n * (order + 1);
            if order > 0 {
                matrices.push(Mat::from_fn(column_count, column_count, |a, b| {
                    self.t[a % n][b % n][index(a / n, b / n)] - eliminated[(a, b)]
                }));
            }
        }
        Ok(matrices)
    }

    /// Poles of the order of a matrix `M`; `None` where it is singular.
    fn poles(&self, m: &Mat<c64>) -> Option<Vec<Pole>> {
        let n = self.inputs;
        let free = m.nrows() - n;
        let matrix = m.view((0, 0), (free, free)).into_owned();
        let rhs = Mat::from_fn(free, n, |a, b| -m[(a, free + b)]);
        let coefficients = jounce_linalg::complex_solve(&matrix, &rhs);
        if !coefficients
            .column_iter()
            .all(|column| column.iter().all(|x| x.re.is_finite() && x.im.is_finite()))
        {
            return None;
        }
        let companion = Mat::from_fn(free, free, |a, b| {
            if a < free - n {
                c64::new(if b == a + n { 1.0 } else { 0.0 }, 0.0)
            } else {
                -coefficients[((b / n) * n + a - (free - n), b % n)]
            }
        });
        let roots = jounce_linalg::complex_eigenvalues(&companion)?;
        let alias_rad_s = TAU / self.interval_s;
        let pole = |z: &c64| {
            let p = -z.ln() / self.interval_s;
            // Once around the circle is the width of the band.
            c64::new(
                p.re,
                p.im + if p.im < 0.0 { alias_rad_s } else { 0.0 } + TAU * self.base_hz,
            )
        };
        let mut result: Vec<Pole> = roots
            .iter()
            .map(pole)
            .filter(|p| p.re < 0.0 && p.re.is_finite())
            .map(Pole::of)
            .collect();
        result.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        Some(result)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::plscf::tests::{exact_responses, shape};
    use super::*;
    use crate::modal::{ModalSettings, ResponseQuantity, identify};

    fn pole(frequency_hz: f64, damping_ratio: f64) -> Pole {
        Pole {
            frequency_hz,
            damping_ratio,
        }
    }

    /// Band between two frequencies of a structure with these modes, measured by eight
    /// accelerometers, from one force or two.
    fn band(between_hz: (f64, f64), modes: &[Pole], inputs: usize) -> Band {
        let frequency_hz: Vec<f64> = (1..6000).map(|k| f64::from(k) * 0.1).collect();
        let mut response = exact_responses(&frequency_hz, modes, shape, 8, inputs);
        for h in &mut response {
            h.iter_mut()
                .zip(&frequency_hz)
                .for_each(|(h, f)| *h *= -(TAU * f).powi(2));
        }
        Band::new(
            &frequency_hz,
            &response,
            &[],
            inputs,
            ResponseQuantity::Acceleration,
            between_hz,
        )
        .unwrap()
    }

    fn modes() -> Vec<Pole> {
        let in_band = [
            pole(213.0, 0.008),
            pole(231.0, 0.01),
            pole(252.0, 0.004),
            pole(289.0, 0.006),
        ];
        [
            &[pole(60.0, 0.01), pole(140.0, 0.01)],
            &in_band[..],
            &[pole(340.0, 0.01), pole(480.0, 0.01)],
        ]
        .concat()
    }

    /// Four modes in a band with two modes below it and two above.
    #[test]
    fn poles_far_from_zero_are_found_with_modes_outside_the_band() {
        for inputs in [1, 2] {
            let result = crate::modal::poles(&band((200.0, 300.0), &modes(), inputs), 24)
                .unwrap()
                .pop()
                .unwrap();
            for pole in &modes()[2..6] {
                let distance = |p: &&Pole| {
                    (p.frequency_hz / pole.frequency_hz - 1.0).abs()
                        + (p.damping_ratio - pole.damping_ratio).abs()
                };
                let nearest = result
                    .iter()
                    .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                    .unwrap();
                let (frequency, damping) = (
                    nearest.frequency_hz / pole.frequency_hz - 1.0,
                    nearest.damping_ratio / pole.damping_ratio - 1.0,
                );
                eprintln!(
                    "{inputs} inputs: {:.0} Hz off by {frequency:.1e}, damping ratio by {damping:.1e}",
                    pole.frequency_hz
                );
                assert!(
                    frequency.abs() < 1e-6 && damping.abs() < 1e-4,
                    "{inputs}: {pole:?} {nearest:?}"
                );
            }
        }
    }

    /// The complete modal analysis of a band: four modes, and one at a low order.
    #[test]
    fn modes_far_from_zero_are_found() {
        let cases = [
            ((200.0, 300.0), 40, modes(), 2..6),
            ((90.0, 130.0), 6, vec![pole(110.0, 0.01)], 0..1),
        ];
        for (between_hz, order, modes, indices) in cases {
            let result = identify(&band(between_hz, &modes, 1), ModalSettings { order }).unwrap();
            for pole in &modes[indices] {
                let relative_error =
                    |mode: &crate::modal::Mode| (mode.frequency_hz / pole.frequency_hz - 1.0).abs();
                let nearest = result
                    .modes
                    .iter()
                    .min_by(|a, b| relative_error(a).total_cmp(&relative_error(b)))
                    .unwrap();
                let damping = nearest.damping_ratio / pole.damping_ratio - 1.0;
                eprintln!(
                    "{:.0} Hz of {} modes off by {:.1e}, damping ratio by {damping:.1e}",
                    pole.frequency_hz,
                    result.modes.len(),
                    relative_error(nearest)
                );
                assert!(
                    relative_error(nearest) < 1e-6 && damping.abs() < 1e-4,
                    "{pole:?} {nearest:?}"
                );
            }
        }
    }

    #[test]
    fn zero_responses_are_an_error() {
        let frequency_hz: Vec<f64> = (100..200).map(f64::from).collect();
        let band = Band::new(
            &frequency_hz,
            &[vec![c64::new(0.0, 0.0); 100]],
            &[],
            1,
            ResponseQuantity::Acceleration,
            (100.0, 200.0),
        )
        .unwrap();
        assert!(matches!(
            crate::modal::poles(&band, 8),
            Err(ModalError::Singular { .. })
        ));
    }
}
