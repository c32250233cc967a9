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

pub(super) const STEPS: usize = 30;
pub(super) const SETTLED: f64 = 1e-10;

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
    let data = Data::of(band, start);
    let mut poles: Vec<c64> = start.iter().map(|pole| pole.complex()).collect();
    let (mut normal, mut right, mut error) = equations(&data, &poles)?;
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let step = damped(&normal, damping)?.solve(&right);
        let tried: Vec<c64> = poles.iter().enumerate().map(|(r, p)| p + c64::new(step[(2 * r, 0)], step[(2 * r + 1, 0)])).collect();
        let size = tried.iter().zip(&poles).map(|(a, b)| (a - b).norm() / b.norm()).fold(0.0, f64::max);
        let stays = tried.iter().all(|p| p.re < 0.0 && p.im > 0.0);
        match equations(&data, &tried).filter(|(.., less)| stays && *less <= error * (1.0 + 1e-12)) {
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
    finished(band, &data, &poles, &normal, error)
}

/// The normal matrix with its diagonal lifted.
pub(super) fn damped(normal: &Mat<f64>, share: f64) -> Option<faer::linalg::solvers::Llt<f64>> {
    let lifted = Mat::from_fn(normal.nrows(), normal.ncols(), |a, b| normal[(a, b)] * if a == b { 1.0 + share } else { 1.0 });
    lifted.llt(Side::Lower).ok()
}

/// What the fit is made to.
pub(super) struct Data {
    /// Of each line that is used, rad/s.
    pub angular: Vec<f64>,
    pub responses: Vec<Weighed>,
}

/// A response at the lines that are used.
pub(super) struct Weighed {
    /// One over the standard deviation of each part.
    pub weight: Vec<f64>,
    /// The response times its weight.
    pub value: Vec<c64>,
}

impl Data {
    pub fn of(band: &Band, start: &[Pole]) -> Self {
        let lines = kept(&band.frequency_hz, start);
        let weighed = |o: usize| {
            let weight = weights(band, o, &lines);
            let value = lines.iter().zip(&weight).map(|(k, weight)| band.response[o][*k] * *weight).collect();
            Weighed { weight, value }
        };
        Self {
            angular: lines.iter().map(|k| TAU * band.frequency_hz[*k]).collect(),
            responses: (0..band.response.len()).into_par_iter().map(weighed).collect(),
        }
    }
}

/// Normal equations of the poles over all responses, and the weighed squared error.
fn equations(data: &Data, poles: &[c64]) -> Option<(Mat<f64>, Mat<f64>, f64)> {
    let size = 2 * poles.len();
    let (mut normal, mut right, mut error) = (Mat::zeros(size, size), Mat::zeros(size, 1), 0.0);
    // Responses in parallel, their parts added in order: the same bits for any number of threads.
    let terms = Terms::of(data, poles);
    let parts = data.responses.par_iter().map(|response| part(response, &terms)).collect::<Option<Vec<Part>>>()?;
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
pub(super) fn linear_terms(poles: &[c64], w: f64, row: &mut Vec<c64>) {
    row.clear();
    let j = c64::new(0.0, 1.0);
    for p in poles {
        let (one, two) = (1.0 / (j * w - p), 1.0 / (j * w - p.conj()));
        row.extend([one + two, j * (one - two)]);
    }
    let low = -1.0 / (w * w);
    row.extend([c64::new(low, 0.0), c64::new(0.0, low), c64::new(1.0, 0.0), j]);
}

/// What all responses share at some poles, not weighed: two rows for each line, its real and its imaginary part.
pub(super) struct Terms {
    /// The columns of the linear unknowns.
    pub linear: Mat<f64>,
    /// For each pole `u + u'` and `j (u - u')`, where `u = 1 / (j w - p)^2` and `u'` is that of the conjugate pole.
    pub squares: Mat<f64>,
}

impl Terms {
    pub fn of(data: &Data, poles: &[c64]) -> Self {
        let (rows, width, j) = (2 * data.angular.len(), 2 * poles.len() + 4, c64::new(0.0, 1.0));
        let (mut linear, mut squares) = (Mat::<f64>::zeros(rows, width), Mat::<f64>::zeros(rows, 2 * poles.len()));
        let mut row = Vec::with_capacity(width);
        for (k, w) in data.angular.iter().copied().enumerate() {
            linear_terms(poles, w, &mut row);
            for (c, value) in row.iter().enumerate() {
                (linear[(2 * k, c)], linear[(2 * k + 1, c)]) = (value.re, value.im);
            }
            for (r, p) in poles.iter().enumerate() {
                let (one, two) = (1.0 / (j * w - p).powi(2), 1.0 / (j * w - p.conj()).powi(2));
                for (c, value) in [one + two, j * (one - two)].into_iter().enumerate() {
                    (squares[(2 * k, 2 * r + c)], squares[(2 * k + 1, 2 * r + c)]) = (value.re, value.im);
                }
            }
        }
        Self { linear, squares }
    }
}

/// Columns scaled to size 1 for the linear solve: residual terms and residues differ by many powers of ten.
fn part(response: &Weighed, terms: &Terms) -> Option<Part> {
    let (rows, width) = (terms.linear.nrows(), terms.linear.ncols());
    let weight = &response.weight;
    let mut a = Mat::from_fn(rows, width, |r, c| weight[r / 2] * terms.linear[(r, c)]);
    let b = Mat::from_fn(rows, 1, |r, _| if r % 2 == 0 { response.value[r / 2].re } else { response.value[r / 2].im });
    let scale: Vec<f64> = (0..width).map(|c| a.col(c).norm_l2().max(f64::MIN_POSITIVE)).collect();
    for (column, scale) in a.col_iter_mut().zip(&scale) {
        column.iter_mut().for_each(|x| *x /= scale);
    }
    let q = a.qr();
    let thin = q.compute_thin_Q();
    let solution = q.thin_R().partial_piv_lu().solve(thin.transpose() * &b);
    let rest = &b - &a * &solution;
    let linear = Mat::from_fn(width, 1, |c, _| solution[(c, 0)] / scale[c]);
    // Derivatives by the real and imaginary part x + j y of each pole's residue times u, and its conjugate.
    let by_poles = Mat::from_fn(rows, width - 4, |row, c| {
        let (r, squares) = (2 * (c / 2), &terms.squares);
        let (x, y) = (linear[(r, 0)], linear[(r + 1, 0)]);
        let (even, odd) = (squares[(row, r)], squares[(row, r + 1)]);
        weight[row / 2] * if c % 2 == 0 { x * even + y * odd } else { x * odd - y * even }
    });
    // Kaufman's variable projection: what the linear terms cannot take up.
    let inside = thin.transpose() * &by_poles;
    let projected = &by_poles - &thin * &inside;
    Some(Part { normal: projected.transpose() * &projected, right: projected.transpose() * &rest, error: rest.squared_norm_l2(), linear })
}

fn finished(band: &Band, data: &Data, poles: &[c64], normal: &Mat<f64>, error: f64) -> Option<Fit> {
    let freedom =
        (2 * data.angular.len() * band.response.len()) as f64 - (2 * poles.len() + band.response.len() * (2 * poles.len() + 4)) as f64;
    let told = !band.variance.is_empty();
    let misfit = error / freedom.max(1.0);
    // Without variances the misfit is all that is known of them.
    let factor = if told { misfit.max(1.0) } else { misfit };
    let covariance = normal.llt(Side::Lower).ok()?.inverse();
    let (mut residue, mut model, mut row) = (Vec::new(), Vec::new(), Vec::new());
    let terms = Terms::of(data, poles);
    for response in &data.responses {
        let linear = part(response, &terms)?.linear;
        residue.push((0..poles.len()).map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)])).collect());
        let at = |f: &f64| {
            linear_terms(poles, TAU * f, &mut row);
            row.iter().enumerate().map(|(c, value)| value * linear[(c, 0)]).sum()
        };
        model.push(band.frequency_hz.iter().map(at).collect());
    }
    Some(Fit {
        poles: poles.iter().map(|p| Pole::of(*p)).collect(),
        deviation: deviations(poles, &covariance, factor),
        residue,
        model,
        misfit,
    })
}

/// Standard deviations of frequency (Hz) and damping ratio from the covariance of the poles' real and imaginary parts, times a factor.
pub(super) fn deviations(poles: &[c64], covariance: &Mat<f64>, factor: f64) -> Vec<(f64, f64)> {
    let deviation = |(r, p): (usize, &c64)| {
        let (vr, vi, c) = (covariance[(2 * r, 2 * r)], covariance[(2 * r + 1, 2 * r + 1)], covariance[(2 * r, 2 * r + 1)]);
        let (a, b, size) = (p.re, p.im, p.norm());
        // |p| and -re p / |p| by the real and the imaginary part.
        let spread = |da: f64, db: f64| ((da * da * vr + db * db * vi + 2.0 * da * db * c) * factor).max(0.0).sqrt();
        (spread(a / size, b / size) / TAU, spread(-b * b / size.powi(3), a * b / size.powi(3)))
    };
    poles.iter().enumerate().map(deviation).collect()
}

/// Residues at some poles: response, mode.
pub(super) fn residues(data: &Data, poles: &[c64]) -> Option<Vec<Vec<c64>>> {
    let terms = Terms::of(data, poles);
    let of = |response: &Weighed| {
        let linear = part(response, &terms)?.linear;
        Some((0..poles.len()).map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)])).collect())
    };
    data.responses.par_iter().map(of).collect()
}
