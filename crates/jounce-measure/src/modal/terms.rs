//! The columns of the modal model at the lines of a band.

use faer::{Mat, c64};

use crate::spectral::Sight;

/// Values of the linear terms at a line: real and imaginary part of each residue, then of `-1/w^2` and of `1, w^2, ..`. What a block leaves of
/// the decay of a mode, `p^m R exp(p t)` for the power `m`, is displacement per force over `(j w)^m`.
pub(super) fn linear_terms((sight, power, upper): (Sight, i32, usize), poles: &[c64], w: f64, row: &mut Vec<c64>) {
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
pub(super) struct Terms {
    /// The columns of the linear unknowns.
    pub linear: Mat<f64>,
    /// For each pole `u + u'` and `j (u - u')`, where `u` is the derivative of its term by the pole, `1 / (j w - p)^2` for blocks that see
    /// all, and `u'` that of the conjugate pole.
    pub squares: Mat<f64>,
}

impl Terms {
    /// Those of each power.
    pub fn of_kinds(sight: Sight, powers: &[i32], angular: &[f64], poles: &[c64], upper: usize) -> Vec<Self> {
        powers.iter().map(|power| Self::of((sight, *power, upper), angular, poles)).collect()
    }

    fn of(kind: (Sight, i32, usize), angular: &[f64], poles: &[c64]) -> Self {
        let (sight, power, upper) = kind;
        let (rows, width, j) = (2 * angular.len(), 2 * poles.len() + 2 + 2 * upper, c64::new(0.0, 1.0));
        let (mut linear, mut squares) = (Mat::<f64>::zeros(rows, width), Mat::<f64>::zeros(rows, 2 * poles.len()));
        let mut row = Vec::with_capacity(width);
        for (k, w) in angular.iter().copied().enumerate() {
            linear_terms(kind, poles, w, &mut row);
            for (c, value) in row.iter().enumerate() {
                (linear[(2 * k, c)], linear[(2 * k + 1, c)]) = (value.re, value.im);
            }
            for (r, p) in poles.iter().enumerate() {
                let (one, two) = (seen(sight, power, w, *p).1, seen(sight, power, w, p.conj()).1);
                for (c, value) in [one + two, j * (one - two)].into_iter().enumerate() {
                    (squares[(2 * k, 2 * r + c)], squares[(2 * k + 1, 2 * r + c)]) = (value.re, value.im);
                }
            }
        }
        Self { linear, squares }
    }
}
