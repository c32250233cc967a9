//! The modal model fitted to all lines of all responses, each weighed by its variance.
//!
//! Gauss-Newton with step control over the poles; residues and residual terms are linear and are eliminated response by response, so that the
//! normal equations are as small as the number of poles. Of many lines those far from every pole are thinned out first.

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Mat, Side, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::thinned::kept;
use super::{Band, Pole};

/// Poles, their covariance, and the residues of every response.
pub(super) struct Fit {
    pub poles: Vec<Pole>,
    /// Standard deviations of frequency (Hz) and damping ratio.
    pub deviation: Vec<(f64, f64)>,
    /// Residues: response, mode.
    pub residue: Vec<Vec<c64>>,
    /// What the model predicts: response, line.
    pub model: Vec<Vec<c64>>,
    /// Squared error over variance, per degree of freedom; the variances are multiplied by it where it is above 1.
    pub misfit: f64,
}

const STEPS: usize = 30;
const SETTLED: f64 = 1e-10;

/// One response's part of the normal equations.
struct Part {
    /// Linear unknowns.
    linear: Mat<f64>,
    /// What the poles' columns leave behind the linear ones: `J^T P J` and `J^T P e`.
    normal: Mat<f64>,
    right: Mat<f64>,
    error: f64,
}

/// The fit that begins at given poles.
pub(super) fn fit(band: &Band, start: &[Pole]) -> Option<Fit> {
    let lines = kept(&band.frequency_hz, start);
    let mut poles: Vec<c64> = start.iter().map(|pole| pole.complex()).collect();
    let (mut normal, mut right, mut error) = equations(band, &lines, &poles)?;
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let step = damped(&normal, damping)?.solve(&right);
        let tried: Vec<c64> = poles.iter().enumerate().map(|(r, p)| p + c64::new(step[(2 * r, 0)], step[(2 * r + 1, 0)])).collect();
        let size = tried.iter().zip(&poles).map(|(a, b)| (a - b).norm() / b.norm()).fold(0.0, f64::max);
        let stays = tried.iter().all(|p| p.re < 0.0 && p.im > 0.0);
        match equations(band, &lines, &tried).filter(|(.., less)| stays && *less <= error * (1.0 + 1e-12)) {
            Some(better) => {
                poles = tried;
                (normal, right, error) = better;
                damping = f64::max(damping * 0.1, 1e-12);
                if size < SETTLED {
                    break;
                }
            }
            None if damping > 1e6 || size < SETTLED => break,
            None => damping *= 10.0,
        }
    }
    finished(band, &lines, &poles, &normal, error)
}

/// The normal matrix with its diagonal lifted.
fn damped(normal: &Mat<f64>, share: f64) -> Option<faer::linalg::solvers::Llt<f64>> {
    let lifted = Mat::from_fn(normal.nrows(), normal.ncols(), |a, b| normal[(a, b)] * if a == b { 1.0 + share } else { 1.0 });
    lifted.llt(Side::Lower).ok()
}

/// Normal equations of the poles over all responses, and the weighed squared error.
fn equations(band: &Band, lines: &[usize], poles: &[c64]) -> Option<(Mat<f64>, Mat<f64>, f64)> {
    let size = 2 * poles.len();
    let (mut normal, mut right, mut error) = (Mat::zeros(size, size), Mat::zeros(size, 1), 0.0);
    // Responses in parallel, their parts added in order: the same bits for any number of threads.
    let parts = (0..band.response.len()).into_par_iter().map(|o| part(band, lines, poles, o)).collect::<Option<Vec<Part>>>()?;
    for part in parts {
        normal += &part.normal;
        right += &part.right;
        error += part.error;
    }
    Some((normal, right, error))
}

/// Weight of each line of a response: one over the standard deviation of each part. Where none is told, the noise is taken as white in what the
/// sensor measures, so that an acceleration's low lines do not count as those of its double integral would.
fn weights(band: &Band, o: usize, lines: &[usize]) -> Vec<f64> {
    match band.variance.get(o) {
        Some(variance) => lines.iter().map(|k| (2.0 / variance[*k]).sqrt()).collect(),
        None => {
            let measured = band.measured(o);
            let rms = (measured.iter().map(|h| h.norm_sqr()).sum::<f64>() / measured.len() as f64).sqrt().max(f64::MIN_POSITIVE);
            lines.iter().map(|k| band.as_measured(o, *k).norm() / rms).collect()
        }
    }
}

/// Values of the linear terms at a line: real and imaginary part of each residue, then of `-1/w^2` and `1`.
fn linear_terms(poles: &[c64], w: f64, row: &mut Vec<c64>) {
    row.clear();
    let j = c64::new(0.0, 1.0);
    for p in poles {
        let (one, two) = (1.0 / (j * w - p), 1.0 / (j * w - p.conj()));
        row.extend([one + two, j * (one - two)]);
    }
    let low = -1.0 / (w * w);
    row.extend([c64::new(low, 0.0), c64::new(0.0, low), c64::new(1.0, 0.0), j]);
}

/// Columns scaled to size 1 for the linear solve: residual terms and residues differ by many powers of ten.
fn part(band: &Band, lines: &[usize], poles: &[c64], o: usize) -> Option<Part> {
    let (rows, width, j) = (2 * lines.len(), 2 * poles.len() + 4, c64::new(0.0, 1.0));
    let mut a = Mat::<f64>::zeros(rows, width);
    let mut b = Mat::<f64>::zeros(rows, 1);
    let mut row = Vec::with_capacity(width);
    let weights = weights(band, o, lines);
    for (k, line) in lines.iter().copied().enumerate() {
        let weight = weights[k];
        linear_terms(poles, TAU * band.frequency_hz[line], &mut row);
        for (c, value) in row.iter().enumerate() {
            (a[(2 * k, c)], a[(2 * k + 1, c)]) = (weight * value.re, weight * value.im);
        }
        let h = band.response[o][line] * weight;
        (b[(2 * k, 0)], b[(2 * k + 1, 0)]) = (h.re, h.im);
    }
    let scale: Vec<f64> = (0..width).map(|c| a.col(c).norm_l2().max(f64::MIN_POSITIVE)).collect();
    let scaled = Mat::from_fn(rows, width, |r, c| a[(r, c)] / scale[c]);
    let q = scaled.qr();
    let thin = q.compute_thin_Q();
    let solution = q.thin_R().partial_piv_lu().solve(thin.transpose() * &b);
    let linear = Mat::from_fn(width, 1, |c, _| solution[(c, 0)] / scale[c]);
    let rest = &b - &a * &linear;
    // Derivatives by the real and imaginary part of each pole.
    let mut by_poles = Mat::<f64>::zeros(rows, 2 * poles.len());
    for (k, line) in lines.iter().copied().enumerate() {
        let (weight, w) = (weights[k], TAU * band.frequency_hz[line]);
        for (r, p) in poles.iter().enumerate() {
            let residue = c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)]);
            let (one, two) = (residue / (j * w - p).powi(2), residue.conj() / (j * w - p.conj()).powi(2));
            for (c, value) in [one + two, j * (one - two)].into_iter().enumerate() {
                (by_poles[(2 * k, 2 * r + c)], by_poles[(2 * k + 1, 2 * r + c)]) = (weight * value.re, weight * value.im);
            }
        }
    }
    // Kaufman's variable projection: what the linear terms cannot take up.
    let inside = thin.transpose() * &by_poles;
    let projected = &by_poles - &thin * &inside;
    Some(Part { normal: projected.transpose() * &projected, right: projected.transpose() * &rest, error: rest.squared_norm_l2(), linear })
}

fn finished(band: &Band, lines: &[usize], poles: &[c64], normal: &Mat<f64>, error: f64) -> Option<Fit> {
    let freedom = (2 * lines.len() * band.response.len()) as f64 - (2 * poles.len() + band.response.len() * (2 * poles.len() + 4)) as f64;
    let told = !band.variance.is_empty();
    let misfit = error / freedom.max(1.0);
    // Without variances the misfit is all that is known of them.
    let factor = if told { misfit.max(1.0) } else { misfit };
    let covariance = normal.llt(Side::Lower).ok()?.inverse();
    let deviation = |(r, p): (usize, &c64)| {
        let (vr, vi, c) = (covariance[(2 * r, 2 * r)], covariance[(2 * r + 1, 2 * r + 1)], covariance[(2 * r, 2 * r + 1)]);
        let (a, b, size) = (p.re, p.im, p.norm());
        // |p| and -re p / |p| by the real and the imaginary part.
        let spread = |da: f64, db: f64| ((da * da * vr + db * db * vi + 2.0 * da * db * c) * factor).max(0.0).sqrt();
        (spread(a / size, b / size) / TAU, spread(-b * b / size.powi(3), a * b / size.powi(3)))
    };
    let (mut residue, mut model, mut row) = (Vec::new(), Vec::new(), Vec::new());
    for o in 0..band.response.len() {
        let linear = part(band, lines, poles, o)?.linear;
        residue.push((0..poles.len()).map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)])).collect());
        let at = |f: &f64| {
            linear_terms(poles, TAU * f, &mut row);
            row.iter().enumerate().map(|(c, value)| value * linear[(c, 0)]).sum()
        };
        model.push(band.frequency_hz.iter().map(at).collect());
    }
    Some(Fit {
        poles: poles.iter().map(|p| Pole::of(*p)).collect(),
        deviation: poles.iter().enumerate().map(deviation).collect(),
        residue,
        model,
        misfit,
    })
}
