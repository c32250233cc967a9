//! Two multipliers that are a complex pair, or have just met on the real axis, with their invariant
//! planes.
use jounce_linalg::{Eigen, Mat, c64, eigen, solve};

/// Largest ratio of two real multipliers that can be a pair that has met.
const MAX_REAL_RATIO: f64 = 1.5;

/// Pair of multipliers.
#[derive(Debug)]
pub struct MultiplierPair {
    /// True where the pair is complex.
    pub is_complex: bool,
    /// Orthonormal basis of the invariant plane of the map, `n x 2`.
    pub right: Mat<f64>,
    /// Basis of the invariant plane of the transposed map, dual to it, `n x 2`.
    pub left_basis: Mat<f64>,
    /// `B`.
    block: [[f64; 2]; 2],
}

impl MultiplierPair {
    /// Returns the pair with the product nearest to one.
    pub fn of(map: &Mat<f64>) -> Option<Self> {
        let (right, values) = plane(map, |[a, b]| ((a * b).re - 1.0).abs())?;
        let (sum, product) = ((values[0] + values[1]).re, (values[0] * values[1]).re);
        let mismatch = |[a, b]: [c64; 2]| ((a + b).re - sum).abs() + ((a * b).re - product).abs();
        let (left_basis, _) = plane(&map.transpose(), mismatch)?;
        let overlap = left_basis.transpose() * &right;
        // W = U (V' U)^-1, so that W' V = I.
        let left_basis = solve(&overlap, &left_basis.transpose())
            .transpose()
            .to_owned();
        let reduced = left_basis.transpose() * map * &right;
        let block = [0, 1].map(|i| [0, 1].map(|j| reduced[(i, j)]));
        let is_finite = block.iter().flatten().all(|entry| entry.is_finite());
        is_finite.then_some(Self {
            is_complex: values[0].im != 0.0,
            right,
            left_basis,
            block,
        })
    }

    /// Returns `det B`, the product of the two multipliers.
    pub fn product(&self) -> f64 {
        self.block[0][0] * self.block[1][1] - self.block[0][1] * self.block[1][0]
    }

    /// Returns the change of the product for a change of `B`.
    pub fn change(&self, by: impl Fn(usize, usize) -> f64) -> f64 {
        let [[a, b], [c, d]] = self.block;
        d * by(0, 0) + a * by(1, 1) - c * by(0, 1) - b * by(1, 0)
    }

    /// Returns an entry of `W' D V` for a change `D` of the map.
    pub fn between(&self, row: usize, column: usize, change: impl Fn(usize, usize) -> f64) -> f64 {
        let n = self.right.nrows();
        let along = |i: usize| {
            (0..n)
                .map(|j| change(i, j) * self.right[(j, column)])
                .sum::<f64>()
        };
        (0..n).map(|i| self.left_basis[(i, row)] * along(i)).sum()
    }
}

/// Returns an orthonormal basis of the plane of the two eigenvalues that are smallest by a measure,
/// and these eigenvalues.
fn plane(map: &Mat<f64>, measure: impl Fn([c64; 2]) -> f64) -> Option<(Mat<f64>, [c64; 2])> {
    let n = map.nrows();
    let Eigen {
        values, vectors, ..
    } = eigen(map)?;
    let is_pair = |&(i, j): &(usize, usize)| {
        let (a, b) = (values[i], values[j]);
        let has_converged = a.im == 0.0
            && b.im == 0.0
            && a.re / b.re < MAX_REAL_RATIO
            && b.re / a.re < MAX_REAL_RATIO
            && a.re * b.re > 0.0;
        (a.im > 0.0 && b == a.conj()) || has_converged
    };
    let pairs = (0..n)
        .flat_map(|i| (0..n).filter(move |j| *j != i).map(move |j| (i, j)))
        .filter(is_pair);
    let (i, j) = pairs.min_by(|a, b| {
        measure([values[a.0], values[a.1]]).total_cmp(&measure([values[b.0], values[b.1]]))
    })?;
    let is_complex = values[i].im != 0.0;
    let columns: [Vec<f64>; 2] = [
        (0..n).map(|k| vectors[(k, i)].re).collect(),
        (0..n)
            .map(|k| {
                if is_complex {
                    vectors[(k, i)].im
                } else {
                    vectors[(k, j)].re
                }
            })
            .collect(),
    ];
    let inner = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let unit = |v: Vec<f64>| {
        let length = inner(&v, &v).sqrt();
        v.into_iter().map(|v| v / length).collect::<Vec<f64>>()
    };
    let [first, second] = columns.map(unit);
    let shared = inner(&first, &second);
    let second = unit(
        second
            .iter()
            .zip(&first)
            .map(|(b, a)| b - shared * a)
            .collect(),
    );
    let basis = Mat::from_fn(
        n,
        2,
        |k, column| if column == 0 { first[k] } else { second[k] },
    );
    Some((basis, [values[i], values[j]]))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::*;

    /// A plane of known trace and determinant, with a further real multiplier.
    fn map(trace: f64, determinant: f64) -> Mat<f64> {
        let rows = [
            [trace, -determinant, 0.3],
            [1.0, 0.0, -0.2],
            [0.0, 0.0, 0.4],
        ];
        Mat::from_fn(3, 3, |i, j| rows[i][j])
    }

    /// Complex, met at a distance of 1e-8, and separate on the real axis: the product changes with
    /// the determinant, not with the trace.
    #[test]
    fn the_product_and_its_change_are_those_of_the_closed_form() {
        let determinant = 1.0;
        for trace in [0.7, 2.0 - 1e-8, 2.0 + 1e-8, 2.02, -2.0 + 1e-8] {
            let current = map(trace, determinant);
            let pair = MultiplierPair::of(&current).unwrap();
            assert_eq!(pair.is_complex, trace.abs() < 2.0);
            assert!(
                (pair.product() - determinant).abs() < 1e-12,
                "{trace}: {}",
                pair.product()
            );
            let product_of = |other: Mat<f64>| {
                pair.change(|row, column| {
                    pair.between(row, column, |i, j| (other[(i, j)] - current[(i, j)]) / 1e-6)
                })
            };
            let (by_trace, by_determinant) = (
                product_of(map(trace + 1e-6, determinant)),
                product_of(map(trace, determinant + 1e-6)),
            );
            assert!(
                by_trace.abs() < 1e-8 && (by_determinant - 1.0).abs() < 1e-8,
                "{trace}: {by_trace:e} {by_determinant}"
            );
        }
    }
}
