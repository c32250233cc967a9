//! Poles by the poly-reference least-squares complex frequency-domain method.
//!
//! The right matrix fraction is `H_o(w) = B_o(z) A(z)^-1`, `z = exp(-j w T)`, `T = 1 / (2 f_high)`,
//! with real coefficients. `A` has size inputs x inputs and order `p`, `B_o` one row for each
//! output. The errors `B_o - H_o A` are linear in the coefficients; eliminating `B` leaves `M a =
//! 0` with
//!
//! ```text
//! M = sum_o T_o - S_o^T R^-1 S_o,   R = re X^H X,  S_o = -re X^H (z^j H_o),  T_o = re (z^j H_o)^H (z^j H_o)
//! ```
//!
//! whose blocks depend only on the difference of powers, so that one pass over the lines serves
//! every order. With the highest coefficient fixed to the identity, poles of noise become undamped
//! or unstable while physical poles do not move: a clear diagram.
use jounce_linalg::{Mat, c64, inverse_cholesky_factor};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::sums::{fourier_sums, signals};
use super::{Pole, complex_plscf};
use crate::modal::{Band, ModalError};

/// Sums over the lines, shared by all orders.
struct PlscfMoments {
    inputs: usize,
    /// `re sum z^k`
    r: Vec<f64>,
    /// `re sum z^k H_o` for k from `-max_order` to `max_order`: output, input, k.
    s: Vec<Vec<Vec<f64>>>,
    /// `re sum z^k conj(H_oi) H_oj`, summed over outputs: i, j, k from `-max_order` to `max_order`.
    t: Vec<Vec<Vec<f64>>>,
    max_order: usize,
    interval_s: f64,
}

/// Poles in the upper half plane for each order from 1 to `max_order`, in ascending frequency,
/// without unstable ones. For a band that begins far from 0, or whose equations from 0 cannot be solved,
/// complex coefficients from its lower end are used.
///
/// # Errors
/// Too few lines, or responses that are all zero.
pub fn poles(band: &Band, max_order: usize) -> Result<Vec<Vec<Pole>>, ModalError> {
    check_line_count(band, max_order)?;
    if band.starts_far_from_zero() {
        return complex_plscf::poles(band, max_order);
    }
    from_zero(band, max_order).or_else(|_| complex_plscf::poles(band, max_order))
}

/// Poles from real coefficients, with the circle beginning at 0 Hz.
///
/// # Errors
/// Too few lines; lines that leave too much of the circle uncovered for the order; responses that
/// are all zero.
pub(super) fn from_zero(band: &Band, max_order: usize) -> Result<Vec<Vec<Pole>>, ModalError> {
    check_line_count(band, max_order)?;
    let moments = PlscfMoments::of(band, max_order);
    let normal = moments.normal()?;
    normal.into_par_iter().map(|m| moments.poles(&m)).collect()
}

fn check_line_count(band: &Band, max_order: usize) -> Result<(), ModalError> {
    let (lines, needed_lines) = (band.frequency_hz.len(), 2 * (max_order + 1) * band.inputs);
    if lines < needed_lines {
        return Err(ModalError::Few {
            low_hz: band.low_hz,
            high_hz: band.high_hz,
            lines,
            order: max_order,
            needed: needed_lines,
        });
    }
    Ok(())
}

impl PlscfMoments {
    fn of(band: &Band, max_order: usize) -> Self {
        let (inputs, outputs) = (band.inputs, band.outputs());
        let highest_hz = band.frequency_hz.iter().copied().fold(0.0, f64::max);
        let interval_s = 1.0 / (2.0 * highest_hz);
        let phasors: Vec<c64> = band
            .frequency_hz
            .iter()
            .map(|f| c64::from_polar(1.0, -TAU * f * interval_s))
            .collect();
        let signals = signals(band);
        let mut sums = fourier_sums(&phasors, &signals, max_order).into_iter();
        let mut rows = |count: usize| -> Vec<Vec<Vec<f64>>> {
            (0..count)
                .map(|_| sums.by_ref().take(inputs).collect())
                .collect()
        };
        let (s, t) = (rows(outputs), rows(inputs));
        let r = sums.next().unwrap_or_default().split_off(max_order);
        Self {
            inputs,
            r,
            s,
            t,
            max_order,
            interval_s,
        }
    }

    /// Matrix `M` of each order from 1. The factor of a leading part of `R` is the leading part of
    /// its factor `L`. With `Y_o = L^-1 S_o`, each order therefore adds one row of each `Y_o` to
    /// `sum_o S_o^T R^-1 S_o = sum_o Y_o^T Y_o`.
    fn normal(&self) -> Result<Vec<Mat<f64>>, ModalError> {
        let (n, width) = (self.inputs, self.max_order + 1);
        // Row a of X is z^a, so that X^H Y has z^(b - a).
        let index = |a: usize, b: usize| self.max_order + b - a;
        let r = Mat::from_fn(width, width, |a, b| self.r[a.abs_diff(b)]);
        let inverse = inverse_cholesky_factor(&r).ok_or(ModalError::Singular {
            order: self.max_order,
        })?;
        let y: Vec<Mat<f64>> = self
            .s
            .par_iter()
            .map(|s| &inverse * Mat::from_fn(width, n * width, |a, b| -s[b % n][index(a, b / n)]))
            .collect();
        let mut eliminated = Mat::<f64>::zeros(n * width, n * width);
        let mut matrices = Vec::new();
        for order in 0..width {
            let row = Mat::from_fn(y.len(), n * width, |o, b| y[o][(order, b)]);
            eliminated += row.transpose() * &row;
            let column_count = n * (order + 1);
            matrices.push(Mat::from_fn(column_count, column_count, |a, b| {
                self.t[a % n][b % n][index(a / n, b / n)] - eliminated[(a, b)]
            }));
        }
        matrices.remove(0);
        Ok(matrices)
    }

    /// Poles of the order of a matrix `M`.
    fn poles(&self, m: &Mat<f64>) -> Result<Vec<Pole>, ModalError> {
        let n = self.inputs;
        let free = m.nrows() - n;
        let singular = ModalError::Singular { order: free / n };
        let matrix = m.view((0, 0), (free, free)).into_owned();
        let rhs = Mat::from_fn(free, n, |a, b| -m[(a, free + b)]);
        let coefficients = jounce_linalg::solve(&matrix, &rhs);
        if !coefficients
            .column_iter()
            .all(|column| column.iter().all(|x| x.is_finite()))
        {
            return Err(singular);
        }
        // det A(z) = 0 for A = sum A_k z^k, A_order = I: the block companion matrix.
        let companion = Mat::from_fn(free, free, |a, b| {
            if a < free - n {
                if b == a + n { 1.0 } else { 0.0 }
            } else {
                // Row of A_k: the coefficients are the rows of A_k, stacked.
                -coefficients[((b / n) * n + a - (free - n), b % n)]
            }
        });
        let roots = jounce_linalg::eigenvalues(&companion).ok_or(singular)?;
        let pole = |z: &c64| -z.ln() / self.interval_s;
        let upper = roots
            .iter()
            .map(pole)
            .filter(|p| p.re < 0.0 && p.im > 0.0 && p.re.is_finite());
        let mut result: Vec<Pole> = upper.map(Pole::of).collect();
        result.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        Ok(result)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
pub(in crate::modal) mod tests {
    use super::*;
    use crate::modal::ResponseQuantity;

    /// Displacement per force of outputs and inputs for known poles and shapes (mass 1).
    pub fn exact_responses(
        frequency_hz: &[f64],
        poles: &[Pole],
        shape: impl Fn(usize, usize) -> f64,
        outputs: usize,
        inputs: usize,
    ) -> Vec<Vec<c64>> {
        let response = |o: usize, i: usize| -> Vec<c64> {
            let at = |f: &f64| {
                let s = c64::new(0.0, TAU * f);
                let mode = |(r, pole): (usize, &Pole)| {
                    let w = TAU * pole.frequency_hz;
                    shape(r, o) * shape(r, i) / (s * s + 2.0 * pole.damping_ratio * w * s + w * w)
                };
                poles.iter().enumerate().map(mode).sum()
            };
            frequency_hz.iter().map(at).collect()
        };
        (0..outputs)
            .flat_map(|o| (0..inputs).map(move |i| (o, i)))
            .map(|(o, i)| response(o, i))
            .collect()
    }

    pub const POLES: [Pole; 4] = [
        Pole {
            frequency_hz: 12.0,
            damping_ratio: 0.01,
        },
        Pole {
            frequency_hz: 31.0,
            damping_ratio: 0.02,
        },
        Pole {
            frequency_hz: 32.0,
            damping_ratio: 0.015,
        },
        Pole {
            frequency_hz: 77.0,
            damping_ratio: 0.005,
        },
    ];

    /// Shape of a string with one irregular point, so that no two modes are alike.
    pub fn shape(mode: usize, point: usize) -> f64 {
        (0.7 * (mode + 1) as f64 * (point + 1) as f64).sin() + 0.1 * point as f64
    }

    /// Includes two close modes. Measured at order 20: frequencies 3e-8, damping ratios 2e-6
    /// relative, with one input and with two.
    #[test]
    fn exact_responses_give_their_poles_from_one_and_two_inputs() {
        let frequency_hz: Vec<f64> = (1..1200).map(|k| f64::from(k) * 0.1).collect();
        for inputs in [1, 2] {
            let response = exact_responses(&frequency_hz, &POLES, shape, 4, inputs);
            let band = Band::new(
                &frequency_hz,
                &response,
                &[],
                inputs,
                ResponseQuantity::Displacement,
                (1.0, 110.0),
            )
            .unwrap();
            let result = poles(&band, 20).unwrap().pop().unwrap();
            for pole in POLES {
                let distance = |p: &&Pole| {
                    (p.frequency_hz / pole.frequency_hz - 1.0).abs()
                        + (p.damping_ratio - pole.damping_ratio).abs()
                };
                let nearest = result
                    .iter()
                    .min_by(|a, b| distance(a).total_cmp(&distance(b)))
                    .unwrap();
                assert!(
                    (nearest.frequency_hz / pole.frequency_hz - 1.0).abs() < 1e-6,
                    "{inputs}: {pole:?} {nearest:?}"
                );
                assert!(
                    (nearest.damping_ratio / pole.damping_ratio - 1.0).abs() < 2e-5,
                    "{inputs}: {pole:?} {nearest:?}"
                );
            }
        }
    }

    #[test]
    fn too_few_lines_and_zero_responses_are_errors() {
        let frequency_hz: Vec<f64> = (1..30).map(f64::from).collect();
        let band = |h: Vec<c64>| {
            Band::new(
                &frequency_hz,
                &[h],
                &[],
                1,
                ResponseQuantity::Acceleration,
                (1.0, 29.0),
            )
            .unwrap()
        };
        assert!(matches!(
            poles(&band(vec![c64::new(1.0, 0.0); 29]), 20),
            Err(ModalError::Few { .. })
        ));
        assert!(matches!(
            poles(&band(vec![c64::new(0.0, 0.0); 29]), 4),
            Err(ModalError::Singular { .. })
        ));
    }
}
