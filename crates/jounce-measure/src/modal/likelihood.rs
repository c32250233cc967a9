//! The modal model fitted to all lines of all responses, each weighed by its variance.
//!
//! Gauss-Newton with step control over the poles; residues and residual terms are linear and are eliminated response by response, so that the
//! normal equations are as small as the number of poles. Of many lines those far from every pole are thinned out first.

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Mat, Side, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::band::LeftOut;
use super::thinned::kept;
use super::{Band, Pole};
use crate::spectral::Sight;

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
    /// Degrees of freedom of the deviations; none where they are known well.
    pub freedom: Option<f64>,
}

const STEPS: usize = 30;
const SETTLED: f64 = 1e-10;

/// The most terms `w^0, w^2, ..` that stand for the modes above the band.
const MOST_UPPER: usize = 8;
/// From so many parts of the blocks on their scatter is known well enough as it is.
const PARTS: usize = 8;

/// One response's part of the normal equations.
struct Part {
    /// Linear unknowns.
    linear: Mat<f64>,
    /// What the linear columns leave of the poles' columns: `P J`.
    projected: Mat<f64>,
    /// `J^T P J` and `J^T P e`.
    normal: Mat<f64>,
    right: Mat<f64>,
    error: f64,
}

/// The fit that begins at given poles, with as many terms for the modes above the band as the responses ask for: one more is kept where
/// the error falls by more than the terms' number lets it (the criterion of Akaike).
pub(super) fn fit(band: &Band, start: &[Pole]) -> Option<Fit> {
    let data = Data::of(band, start);
    let mut found = settled(&data, start.iter().map(|pole| pole.complex()).collect(), 1)?;
    let numbers = (2 * data.angular.len() * data.responses.len()) as f64;
    for upper in 2..=MOST_UPPER {
        let Some(tried) = settled(&data, found.poles.clone(), upper) else { break };
        // Two more numbers for each response.
        if numbers * (found.error / tried.error).ln() < 4.0 * data.responses.len() as f64 {
            break;
        }
        found = tried;
    }
    finished(band, &data, &found)
}

/// Poles at the least error, with so many terms for the modes above the band.
struct Settled {
    poles: Vec<c64>,
    upper: usize,
    normal: Mat<f64>,
    error: f64,
}

fn settled(data: &Data, mut poles: Vec<c64>, upper: usize) -> Option<Settled> {
    let (mut normal, mut right, mut error) = equations(data, &poles, upper)?;
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let step = damped(&normal, damping)?.solve(&right);
        let tried: Vec<c64> = poles.iter().enumerate().map(|(r, p)| p + c64::new(step[(2 * r, 0)], step[(2 * r + 1, 0)])).collect();
        let size = tried.iter().zip(&poles).map(|(a, b)| (a - b).norm() / b.norm()).fold(0.0, f64::max);
        let stays = tried.iter().all(|p| p.re < 0.0 && p.im > 0.0);
        match equations(data, &tried, upper).filter(|(.., less)| stays && *less <= error * (1.0 + 1e-12)) {
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
    Some(Settled { poles, upper, normal, error })
}

/// The normal matrix with its diagonal lifted.
fn damped(normal: &Mat<f64>, share: f64) -> Option<faer::linalg::solvers::Llt<f64>> {
    let lifted = Mat::from_fn(normal.nrows(), normal.ncols(), |a, b| normal[(a, b)] * if a == b { 1.0 + share } else { 1.0 });
    lifted.llt(Side::Lower).ok()
}

/// What the fit is made to.
struct Data {
    /// The lines that are used.
    lines: Vec<usize>,
    /// Of each of them, rad/s.
    angular: Vec<f64>,
    sight: Sight,
    responses: Vec<Weighed>,
    /// What the responses measure, each kind once.
    powers: Vec<i32>,
}

/// A response at the lines that are used.
struct Weighed {
    /// Place of its power of `j w` among those of the data.
    kind: usize,
    /// One over the standard deviation of each part.
    weight: Vec<f64>,
    /// The response times its weight.
    value: Vec<c64>,
}

impl Data {
    fn of(band: &Band, start: &[Pole]) -> Self {
        let lines = kept(&band.frequency_hz, start);
        // Where blocks see all of a decay, what the power changes is a part of the terms above and below the band.
        let power = |o: usize| if band.sight == Sight::Whole { 0 } else { band.power[o] };
        let mut powers: Vec<i32> = (0..band.response.len()).map(power).collect();
        powers.sort_unstable();
        powers.dedup();
        let weighed = |o: usize| {
            let kind = powers.iter().position(|of| *of == power(o)).unwrap_or(0);
            let weight = weights(band, o, &lines);
            let value = lines.iter().zip(&weight).map(|(k, weight)| band.response[o][*k] * *weight).collect();
            Weighed { kind, weight, value }
        };
        Self {
            angular: lines.iter().map(|k| TAU * band.frequency_hz[*k]).collect(),
            sight: band.sight,
            responses: (0..band.response.len()).into_par_iter().map(weighed).collect(),
            lines,
            powers,
        }
    }
}

/// Normal equations of the poles over all responses, and the weighed squared error.
fn equations(data: &Data, poles: &[c64], upper: usize) -> Option<(Mat<f64>, Mat<f64>, f64)> {
    let size = 2 * poles.len();
    let (mut normal, mut right, mut error) = (Mat::zeros(size, size), Mat::zeros(size, 1), 0.0);
    // Responses in parallel, their parts added in order: the same bits for any number of threads.
    let terms = Terms::of_kinds(data, poles, upper);
    let parts = data.responses.par_iter().map(|response| part(response, &terms[response.kind])).collect::<Option<Vec<Part>>>()?;
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

/// Values of the linear terms at a line: real and imaginary part of each residue, then of `-1/w^2` and of `1, w^2, ..`. What a block leaves of
/// the decay of a mode, `p^m R exp(p t)` for the power `m`, is displacement per force over `(j w)^m`.
fn linear_terms((sight, power, upper): (Sight, i32, usize), poles: &[c64], w: f64, row: &mut Vec<c64>) {
    row.clear();
    let j = c64::new(0.0, 1.0);
    for p in poles {
        let (one, two) = (seen(sight, power, w, *p).0, seen(sight, power, w, p.conj()).0);
        row.extend([one + two, j * (one - two)]);
    }
    let mut residual = -1.0 / (w * w);
    row.extend([c64::new(residual, 0.0), c64::new(0.0, residual)]);
    residual = 1.0;
    for _ in 0..upper {
        row.extend([c64::new(residual, 0.0), c64::new(0.0, residual)]);
        residual *= w * w;
    }
}

/// `(p / j w)^m G(j w - p)` and its derivative by `p`.
fn seen(sight: Sight, power: i32, w: f64, p: c64) -> (c64, c64) {
    let (value, slope) = sight.transform(c64::new(0.0, w) - p);
    let factor = (p / c64::new(0.0, w)).powi(power);
    (factor * value, factor * (f64::from(power) * value / p - slope))
}

/// What all responses share at some poles, not weighed: two rows for each line, its real and its imaginary part.
struct Terms {
    /// The columns of the linear unknowns.
    linear: Mat<f64>,
    /// For each pole `u + u'` and `j (u - u')`, where `u` is the derivative of its term by the pole, `1 / (j w - p)^2` for blocks that see
    /// all, and `u'` that of the conjugate pole.
    squares: Mat<f64>,
}

impl Terms {
    /// Those of each power.
    fn of_kinds(data: &Data, poles: &[c64], upper: usize) -> Vec<Self> {
        data.powers.iter().map(|power| Self::of(data, poles, *power, upper)).collect()
    }

    fn of(data: &Data, poles: &[c64], power: i32, upper: usize) -> Self {
        let (rows, width, j) = (2 * data.angular.len(), 2 * poles.len() + 2 + 2 * upper, c64::new(0.0, 1.0));
        let (mut linear, mut squares) = (Mat::<f64>::zeros(rows, width), Mat::<f64>::zeros(rows, 2 * poles.len()));
        let mut row = Vec::with_capacity(width);
        for (k, w) in data.angular.iter().copied().enumerate() {
            linear_terms((data.sight, power, upper), poles, w, &mut row);
            for (c, value) in row.iter().enumerate() {
                (linear[(2 * k, c)], linear[(2 * k + 1, c)]) = (value.re, value.im);
            }
            for (r, p) in poles.iter().enumerate() {
                let (one, two) = (seen(data.sight, power, w, *p).1, seen(data.sight, power, w, p.conj()).1);
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
    let by_poles = Mat::from_fn(rows, terms.squares.ncols(), |row, c| {
        let (r, squares) = (2 * (c / 2), &terms.squares);
        let (x, y) = (linear[(r, 0)], linear[(r + 1, 0)]);
        let (even, odd) = (squares[(row, r)], squares[(row, r + 1)]);
        weight[row / 2] * if c % 2 == 0 { x * even + y * odd } else { x * odd - y * even }
    });
    // Kaufman's variable projection: what the linear terms cannot take up.
    let inside = thin.transpose() * &by_poles;
    let projected = &by_poles - &thin * &inside;
    let (normal, right) = (projected.transpose() * &projected, projected.transpose() * &rest);
    Some(Part { linear, projected, normal, right, error: rest.squared_norm_l2() })
}

fn finished(band: &Band, data: &Data, found: &Settled) -> Option<Fit> {
    let (poles, upper) = (&found.poles, found.upper);
    let linear = band.response.len() * (2 * poles.len() + 2 + 2 * upper);
    let misfit = found.error / ((2 * data.angular.len() * band.response.len()) as f64 - (2 * poles.len() + linear) as f64).max(1.0);
    let terms = Terms::of_kinds(data, poles, upper);
    let parts = data.responses.par_iter().map(|response| part(response, &terms[response.kind])).collect::<Option<Vec<Part>>>()?;
    let inverse = found.normal.llt(Side::Lower).ok()?.inverse();
    let turns = if band.parts.len() < PARTS && matches!(band.sight, Sight::Cut { .. }) { 2 } else { 1 };
    let covariance = match &band.parts[..] {
        // Without variances the misfit is all that is known of them.
        [] if band.variance.is_empty() => inverse * misfit,
        [] => inverse * misfit.max(1.0),
        left_out => &inverse * scatter(data, &parts, left_out, turns) * &inverse * misfit.max(1.0),
    };
    let deviation = |(r, p): (usize, &c64)| {
        let (vr, vi, c) = (covariance[(2 * r, 2 * r)], covariance[(2 * r + 1, 2 * r + 1)], covariance[(2 * r, 2 * r + 1)]);
        let (a, b, size) = (p.re, p.im, p.norm());
        // |p| and -re p / |p| by the real and the imaginary part.
        let spread = |da: f64, db: f64| (da * da * vr + db * db * vi + 2.0 * da * db * c).max(0.0).sqrt();
        (spread(a / size, b / size) / TAU, spread(-b * b / size.powi(3), a * b / size.powi(3)))
    };
    let (mut residue, mut model, mut row) = (Vec::new(), Vec::new(), Vec::new());
    for (part, response) in parts.iter().zip(&data.responses) {
        let (linear, power) = (&part.linear, data.powers[response.kind]);
        residue.push((0..poles.len()).map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)])).collect());
        let at = |f: &f64| {
            linear_terms((data.sight, power, upper), poles, TAU * f, &mut row);
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
        freedom: (!band.parts.is_empty()).then(|| (turns * (band.parts.len() - 1)) as f64),
    })
}

/// Covariance of `J^T P e` from leaving out one part of the blocks after the other (the jackknife), all lines and responses together: noise of
/// the force is common to the responses, and windows make neighbouring lines alike. The noise of a few hits has no preferred phase: turned by
/// 90 degrees, a second turn, what is left out tells as much again. What leaks between the blocks of a force that goes on has one.
fn scatter(data: &Data, responses: &[Part], left_out: &[LeftOut], turns: usize) -> Mat<f64> {
    let size = responses.first().map_or(0, |part| part.projected.ncols());
    let one = |left: &LeftOut| {
        let mut sums = Mat::<f64>::zeros(size, turns);
        for ((part, weighed), change) in responses.iter().zip(&data.responses).zip(&left.change) {
            let turned = Mat::from_fn(part.projected.nrows(), turns, |row, turn| {
                let change = change[data.lines[row / 2]] * weighed.weight[row / 2];
                match (row % 2, turn) {
                    (0, 0) | (1, 1) => change.re,
                    (0, _) => -change.im,
                    _ => change.im,
                }
            });
            sums += part.projected.transpose() * turned;
        }
        (&sums * sums.transpose()) * ((1.0 - left.share) / turns as f64)
    };
    left_out.iter().map(one).fold(Mat::zeros(size, size), |sum, one| sum + one)
}
