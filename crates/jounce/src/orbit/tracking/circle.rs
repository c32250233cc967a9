//! A complex pair of multipliers on the unit circle, as a scalar that is zero there.
//!
//! ```text
//! g = |m|^2 - 1,   dg = 2 Re(conj(m) w' dM v),   M v = m v,   w' M = m w',   w' v = 1
//! ```
//!
//! `M` is the derivative of a flow, whose second derivative is symmetric: two shots, along the real and the imaginary part of `v`, give
//! the whole gradient. Where the pair meets on the real axis (strong resonance) there is no such scalar and the curve ends.
//!
//! Source: Y. A. Kuznetsov, Elements of Applied Bifurcation Theory (Springer, 2004), ch. 4 and 5.

use super::condition::Gradient;
use crate::orbit::Shot;
use faer::linalg::solvers::Solve;
use faer::{ColRef, Mat, c64};

/// Move along an eigenvector for the second derivative, beside the size of the state.
const MOVE: f64 = 1e-5;

/// Smallest imaginary part of a pair.
const COMPLEX: f64 = 1e-9;

/// A multiplier with its eigenvectors.
struct Pair {
    multiplier: c64,
    right: Vec<c64>,
    left: Vec<c64>,
}

impl Pair {
    /// The complex multiplier nearest to the unit circle.
    fn of(map: &Mat<f64>) -> Option<Self> {
        let n = map.nrows();
        let eigen = map.eigen().ok()?;
        let (values, vectors) = (eigen.S().column_vector().to_owned(), eigen.U().to_owned());
        let off = |k: usize| (values[k].norm() - 1.0).abs();
        let k = (0..n).filter(|k| values[*k].im > COMPLEX).min_by(|a, b| off(*a).total_cmp(&off(*b)))?;
        let unit = Mat::from_fn(n, 1, |i, _| c64::new(f64::from(u8::from(i == k)), 0.0));
        let left = vectors.transpose().to_owned().partial_piv_lu().solve(&unit);
        let found =
            Self { multiplier: values[k], right: (0..n).map(|i| vectors[(i, k)]).collect(), left: (0..n).map(|i| left[(i, 0)]).collect() };
        found.left.iter().all(|w| w.re.is_finite() && w.im.is_finite()).then_some(found)
    }

    /// `dg` for a change of the multiplier.
    fn change(&self, by: c64) -> f64 {
        2.0 * (self.multiplier.conj() * by).re
    }

    /// `w' D v` for a change `D` of the map.
    fn along(&self, change: impl Fn(usize, usize) -> f64) -> c64 {
        let n = self.right.len();
        let row = |i: usize| (0..n).map(|j| self.right[j] * change(i, j)).sum::<c64>();
        (0..n).map(|i| self.left[i] * row(i)).sum()
    }
}

/// `g` with its gradient; `None` without a complex pair. See [`super::Condition::gradient`].
pub fn gradient<E>(
    shot: &Shot,
    aside: [&Shot; 2],
    differences: [f64; 2],
    moved: impl Fn(&[f64]) -> Result<Shot, E>,
) -> Result<Option<Gradient>, E> {
    let Some(pair) = Pair::of(&shot.map) else { return Ok(None) };
    let n = pair.right.len();
    let step = MOVE * ColRef::from_slice(&shot.looks[0]).norm_l2();
    let part = |read: fn(&c64) -> f64| moved(&pair.right.iter().map(|v| step * read(v)).collect::<Vec<_>>());
    let (real, imaginary) = (part(|v| v.re)?, part(|v| v.im)?);
    let by = |j: usize| -> c64 {
        let entry = |i: usize| c64::new(real.map[(i, j)] - shot.map[(i, j)], imaginary.map[(i, j)] - shot.map[(i, j)]);
        (0..n).map(|i| pair.left[i] * entry(i)).sum::<c64>() / step
    };
    let by_parameter = |k: usize| pair.change(pair.along(|i, j| (aside[k].map[(i, j)] - shot.map[(i, j)]) / differences[k]));
    Ok(Some(Gradient {
        value: pair.multiplier.norm_sqr() - 1.0,
        by_unknown: (0..n).map(|j| pair.change(by(j))).collect(),
        by_parameters: [by_parameter(0), by_parameter(1)],
        bend: None,
    }))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::*;

    /// A rotation by `angle` that grows by `size`, beside a real multiplier: the change of the pair with `size` is `e^{i angle}`.
    #[test]
    fn a_multiplier_moves_with_its_matrix_as_the_closed_form_says() {
        let map = |size: f64, angle: f64| {
            let (s, c) = angle.sin_cos();
            let rows = [[size * c, -size * s, 0.3], [size * s, size * c, -0.2], [0.0, 0.0, 0.4]];
            Mat::from_fn(3, 3, |i, j| rows[i][j])
        };
        let (size, angle) = (1.1, 0.7);
        let pair = Pair::of(&map(size, angle)).unwrap();
        assert!((pair.multiplier - c64::from_polar(size, angle)).norm() < 1e-14);
        let (a, b) = (map(size, angle), map(size + 1e-6, angle));
        let moved = pair.along(|i, j| (b[(i, j)] - a[(i, j)]) / 1e-6);
        assert!((moved - c64::from_polar(1.0, angle)).norm() < 1e-9, "{moved}");
        assert!((pair.change(moved) - 2.0 * size).abs() < 1e-9);
    }
}
