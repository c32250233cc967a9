//! Poles by the poly-reference least-squares complex frequency-domain method.
//!
//! The right matrix fraction `H_o(w) = B_o(z) A(z)^-1`, `z = exp(-j w T)`, `T = 1 / (2 f_high)`, with real coefficients: `A` of size
//! inputs x inputs and order `p`, `B_o` a row for each output. The errors `B_o - H_o A` are linear in the coefficients; eliminating `B` leaves
//! `M a = 0` with
//!
//! ```text
//! M = sum_o T_o - S_o^T R^-1 S_o,   R = re X^H X,  S_o = -re X^H (z^j H_o),  T_o = re (z^j H_o)^H (z^j H_o)
//! ```
//!
//! whose blocks depend on the difference of powers only, so that one pass over the lines serves every order. With the highest coefficient
//! fixed to the identity, poles of noise come out undamped or growing and the others stay: a clear diagram.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::{Band, ModalError, Pole};

/// Sums over the lines that every order shares.
struct Moments {
    inputs: usize,
    /// `re sum z^k`
    r: Vec<f64>,
    /// `re sum z^k H_o` for k from `-most` to `most`: output, input, k.
    s: Vec<Vec<Vec<f64>>>,
    /// `re sum z^k conj(H_oi) H_oj`, summed over outputs: i, j, k from `-most` to `most`.
    t: Vec<Vec<Vec<f64>>>,
    most: usize,
    interval_s: f64,
}

/// Poles in the upper half plane for each order from 1 to `most`, in ascending frequency; those that grow are left out.
///
/// # Errors
/// Too few lines, or responses that are all zero.
pub fn poles(band: &Band, most: usize) -> Result<Vec<Vec<Pole>>, ModalError> {
    let (lines, needed) = (band.frequency_hz.len(), 2 * (most + 1) * band.inputs);
    if lines < needed {
        return Err(ModalError::Few { low_hz: band.low_hz, high_hz: band.high_hz, lines, order: most, needed });
    }
    let moments = Moments::of(band, most);
    let normal = moments.normal()?;
    normal.into_par_iter().map(|m| moments.poles(&m)).collect()
}

impl Moments {
    fn of(band: &Band, most: usize) -> Self {
        let (inputs, outputs) = (band.inputs, band.outputs());
        let highest = band.frequency_hz.iter().copied().fold(0.0, f64::max);
        let interval_s = 1.0 / (2.0 * highest);
        let turn: Vec<c64> = band.frequency_hz.iter().map(|f| c64::from_polar(1.0, -TAU * f * interval_s)).collect();
        // As measured: displacement would give the lowest lines all the weight. Responses of one size each, so that no sensor's unit decides; of
        // several inputs first all of an output, then all to an input share a factor, which leaves the poles as they are.
        let mut response: Vec<Vec<c64>> = (0..band.response.len()).map(|k| band.measured(k)).collect();
        (0..outputs).for_each(|o| of_one_size(response[o * inputs..(o + 1) * inputs].iter_mut()));
        if inputs > 1 {
            (0..inputs).for_each(|i| of_one_size(response.iter_mut().skip(i).step_by(inputs)));
        }
        let at = |o: usize, i: usize| &response[o * inputs + i];
        let product = |i: usize, j: usize| -> Vec<c64> {
            (0..turn.len()).map(|k| (0..outputs).map(|o| at(o, i)[k].conj() * at(o, j)[k]).sum()).collect()
        };
        let products = (0..inputs).flat_map(|i| (0..inputs).map(move |j| (i, j))).map(|(i, j)| product(i, j));
        let ones = vec![c64::new(1.0, 0.0); turn.len()];
        let signals: Vec<Vec<c64>> = response.iter().cloned().chain(products).chain([ones]).collect();
        let mut sums = both_ways(&turn, &signals, most).into_iter();
        let mut rows = |count: usize| -> Vec<Vec<Vec<f64>>> { (0..count).map(|_| sums.by_ref().take(inputs).collect()).collect() };
        let (s, t) = (rows(outputs), rows(inputs));
        let r = sums.next().unwrap_or_default().split_off(most);
        Self { inputs, r, s, t, most, interval_s }
    }

    /// The matrix `M` of each order from 1. The factor of a leading part of `R` is the leading part of its factor `L`, so that with
    /// `Y_o = L^-1 S_o` each order adds to `sum_o S_o^T R^-1 S_o = sum_o Y_o^T Y_o` what one row of each `Y_o` gives.
    fn normal(&self) -> Result<Vec<Mat<f64>>, ModalError> {
        let (n, width) = (self.inputs, self.most + 1);
        // Row a of X is z^a, so that X^H Y has z^(b - a).
        let index = |a: usize, b: usize| self.most + b - a;
        let r = Mat::from_fn(width, width, |a, b| self.r[a.abs_diff(b)]);
        let factor = r.llt(Side::Lower).map_err(|_| ModalError::Singular { order: self.most })?;
        let inverse = {
            let mut inverse = Mat::<f64>::identity(width, width);
            factor.L().solve_lower_triangular_in_place(&mut inverse);
            inverse
        };
        let y: Vec<Mat<f64>> =
            self.s.par_iter().map(|s| &inverse * Mat::from_fn(width, n * width, |a, b| -s[b % n][index(a, b / n)])).collect();
        let mut taken = Mat::<f64>::zeros(n * width, n * width);
        let mut all = Vec::new();
        for order in 0..width {
            let row = Mat::from_fn(y.len(), n * width, |o, b| y[o][(order, b)]);
            taken += row.transpose() * &row;
            let size = n * (order + 1);
            all.push(Mat::from_fn(size, size, |a, b| self.t[a % n][b % n][index(a / n, b / n)] - taken[(a, b)]));
        }
        all.remove(0);
        Ok(all)
    }

    /// The poles of the order that a matrix `M` belongs to.
    fn poles(&self, m: &Mat<f64>) -> Result<Vec<Pole>, ModalError> {
        let n = self.inputs;
        let free = m.nrows() - n;
        let singular = ModalError::Singular { order: free / n };
        let left = m.submatrix(0, 0, free, free).to_owned();
        let right = Mat::from_fn(free, n, |a, b| -m[(a, free + b)]);
        let lu = left.partial_piv_lu();
        let coefficients = lu.solve(&right);
        if !coefficients.col_iter().all(|column| column.iter().all(|x| x.is_finite())) {
            return Err(singular);
        }
        // det A(z) = 0 for A = sum A_k z^k, A_order = I: the block companion matrix.
        let companion = Mat::from_fn(free, free, |a, b| {
            if a < free - n {
                if b == a + n { 1.0 } else { 0.0 }
            } else {
                // Row of A_k: the coefficients stand with the rows of A_k below each other.
                -coefficients[((b / n) * n + a - (free - n), b % n)]
            }
        });
        let roots = companion.eigenvalues().map_err(|_| singular)?;
        let pole = |z: &c64| -z.ln() / self.interval_s;
        let upper = roots.iter().map(pole).filter(|p| p.re < 0.0 && p.im > 0.0 && p.re.is_finite());
        let mut found: Vec<Pole> = upper.map(Pole::of).collect();
        found.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        Ok(found)
    }
}

/// Divides responses by the rms of all of them.
fn of_one_size<'a>(responses: impl Iterator<Item = &'a mut Vec<c64>>) {
    let mut responses: Vec<&mut Vec<c64>> = responses.collect();
    let (sum, lines) = responses.iter().flat_map(|h| h.iter()).fold((0.0, 0), |(sum, lines), x| (sum + x.norm_sqr(), lines + 1));
    let size = (sum / f64::from(lines)).sqrt();
    if size > 0.0 {
        responses.iter_mut().flat_map(|h| h.iter_mut()).for_each(|x| *x /= size);
    }
}

/// Lines whose sums are made at once; these are added in order, so that any number of threads gives the same bits.
const LINES: usize = 1024;
/// Numbers that are added side by side.
const LANES: usize = 8;

/// `re sum z^k h` of each signal `h` for k from `-most` to `most`. With `a = sum re z^k re h` and `b = sum im z^k im h` the sums of `k` and `-k` are
/// `a - b` and `a + b`, and the powers of `z` serve all signals.
fn both_ways(turn: &[c64], signals: &[Vec<c64>], most: usize) -> Vec<Vec<f64>> {
    let part = |from: usize| -> Vec<[f64; 2]> {
        let lines = from..(from + LINES).min(turn.len());
        let apart = |of: &[c64]| of[lines.clone()].iter().flat_map(|x| [x.re, x.im]).collect::<Vec<f64>>();
        let signals: Vec<Vec<f64>> = signals.iter().map(|h| apart(h)).collect();
        let mut power = [1.0, 0.0].repeat(lines.len());
        let mut sums = Vec::with_capacity(signals.len() * (most + 1));
        for _ in 0..=most {
            sums.extend(signals.iter().map(|h| products(&power, h)));
            for (power, z) in power.as_chunks_mut::<2>().0.iter_mut().zip(&turn[lines.clone()]) {
                *power = [power[0] * z.re - power[1] * z.im, power[0] * z.im + power[1] * z.re];
            }
        }
        sums
    };
    let parts: Vec<Vec<[f64; 2]>> = (0..turn.len()).into_par_iter().step_by(LINES).map(part).collect();
    let mut sums = vec![vec![0.0; 2 * most + 1]; signals.len()];
    for part in parts {
        for (index, [a, b]) in part.into_iter().enumerate() {
            let (k, signal) = (index / signals.len(), &mut sums[index % signals.len()]);
            signal[most + k] += a - b;
            if k > 0 {
                signal[most - k] += a + b;
            }
        }
    }
    sums
}

/// Sums of the products of real parts and of imaginary parts, which stand by turns.
fn products(x: &[f64], y: &[f64]) -> [f64; 2] {
    let mut lanes = [0.0; LANES];
    let (x, y) = (x.chunks(LANES), y.chunks(LANES));
    for (x, y) in x.zip(y) {
        for (lane, (x, y)) in lanes.iter_mut().zip(x.iter().zip(y)) {
            *lane += x * y;
        }
    }
    let every = |from: usize| lanes.iter().skip(from).step_by(2).sum();
    [every(0), every(1)]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
pub(super) mod tests {
    use super::super::Motion;
    use super::*;

    /// Displacement per force of outputs and inputs for known poles and shapes (mass 1).
    pub fn exact(
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
        (0..outputs).flat_map(|o| (0..inputs).map(move |i| (o, i))).map(|(o, i)| response(o, i)).collect()
    }

    pub const POLES: [Pole; 4] = [
        Pole { frequency_hz: 12.0, damping_ratio: 0.01 },
        Pole { frequency_hz: 31.0, damping_ratio: 0.02 },
        Pole { frequency_hz: 32.0, damping_ratio: 0.015 },
        Pole { frequency_hz: 77.0, damping_ratio: 0.005 },
    ];

    /// Shape of a string with one odd point, so that no two modes look alike.
    pub fn shape(mode: usize, point: usize) -> f64 {
        (0.7 * (mode + 1) as f64 * (point + 1) as f64).sin() + 0.1 * point as f64
    }

    /// Two close modes among them. Measured at order 20: frequencies 3e-8, damping ratios 2e-6 relative, with one input and with two.
    #[test]
    fn exact_responses_give_back_their_poles_from_one_and_two_inputs() {
        let frequency_hz: Vec<f64> = (1..1200).map(|k| f64::from(k) * 0.1).collect();
        for inputs in [1, 2] {
            let response = exact(&frequency_hz, &POLES, shape, 4, inputs);
            let band = Band::new(&frequency_hz, &response, &[], inputs, Motion::Displacement, (1.0, 110.0)).unwrap();
            let found = poles(&band, 20).unwrap().pop().unwrap();
            for pole in POLES {
                let distance = |p: &&Pole| (p.frequency_hz / pole.frequency_hz - 1.0).abs() + (p.damping_ratio - pole.damping_ratio).abs();
                let nearest = found.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
                assert!((nearest.frequency_hz / pole.frequency_hz - 1.0).abs() < 1e-6, "{inputs}: {pole:?} {nearest:?}");
                assert!((nearest.damping_ratio / pole.damping_ratio - 1.0).abs() < 2e-5, "{inputs}: {pole:?} {nearest:?}");
            }
        }
    }

    #[test]
    fn too_few_lines_and_zero_responses_are_errors() {
        let frequency_hz: Vec<f64> = (1..30).map(f64::from).collect();
        let band = |h: Vec<c64>| Band::new(&frequency_hz, &[h], &[], 1, Motion::Acceleration, (1.0, 29.0)).unwrap();
        assert!(matches!(poles(&band(vec![c64::new(1.0, 0.0); 29]), 20), Err(ModalError::Few { .. })));
        assert!(matches!(poles(&band(vec![c64::new(0.0, 0.0); 29]), 4), Err(ModalError::Singular { .. })));
    }
}
