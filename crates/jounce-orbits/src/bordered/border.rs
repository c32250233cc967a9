//! Square matrix with a border of one row and one column.

use jounce_linalg::{LuFactors, Mat, column_mut};

/// `(x, p)`; `None` where the bordered matrix is singular.
pub type BorderedSolution = Option<(Vec<f64>, f64)>;

/// `[A b; row corner]`, factored. The border may have its own units: its row and column are scaled
/// to norm one.
#[derive(Debug)]
pub struct Bordered {
    factors: LuFactors,
    row_size: f64,
    column_size: f64,
}

impl Bordered {
    /// Factors a matrix with its border.
    pub fn new(matrix: &Mat<f64>, column: &[f64], (row, corner): (&[f64], f64)) -> Self {
        let n = row.len();
        let row_size = row.iter().fold(corner.abs(), |max, r| max.max(r.abs()));
        let column_size = column
            .iter()
            .fold(f64::MIN_POSITIVE, |max, r| max.max(r.abs()));
        let mut bordered = Mat::zeros(n + 1, n + 1);
        for j in 0..n {
            column_mut(&mut bordered, j)[..n].copy_from_slice(jounce_linalg::column(matrix, j));
            bordered[(n, j)] = row[j] / row_size;
            bordered[(j, n)] = column[j] / column_size;
        }
        bordered[(n, n)] = corner / (row_size * column_size);
        Self {
            factors: LuFactors::of(&bordered),
            row_size,
            column_size,
        }
    }

    /// Solves `[A b; row corner] (x, p) = (right, last)`.
    pub fn solve(&self, right: &[f64], last: f64) -> BorderedSolution {
        let mut unknown: Vec<f64> = right
            .iter()
            .copied()
            .chain([last / self.row_size])
            .collect();
        self.factors.solve(&mut unknown);
        let parameter = unknown.pop()? / self.column_size;
        (parameter.is_finite() && unknown.iter().all(|u| u.is_finite()))
            .then_some((unknown, parameter))
    }
}

/// Solves `[A b; row corner] (x, p) = (right, last)`.
pub fn solve_bordered(
    matrix: &Mat<f64>,
    column: &[f64],
    border: (&[f64], f64),
    (right, last): (&[f64], f64),
) -> BorderedSolution {
    Bordered::new(matrix, column, border).solve(right, last)
}

/// Row and corner of the first border of a matrix.
#[derive(Debug)]
pub struct Border {
    row: Vec<f64>,
    corner: f64,
}

impl Border {
    /// Creates a border from its row and corner.
    pub fn new((row, corner): (&[f64], f64)) -> Self {
        Self {
            row: row.to_vec(),
            corner,
        }
    }

    /// Returns `row . x`.
    pub fn along(&self, x: &[f64]) -> f64 {
        self.row.iter().zip(x).map(|(r, x)| r * x).sum()
    }

    /// Returns the solution under another border, from solutions under this one.
    ///
    /// ```text
    /// (B + e v)^-1 r = x - z (v x) / (1 + v z),   B x = r,   B z = e
    /// ```
    ///
    /// `B` is the matrix with this border, `e` the last unit vector, `v` the difference between the
    /// other row and this one.
    pub fn other(
        &self,
        (row, corner): (&[f64], f64),
        (right, last): (&[f64], f64),
        solve: impl Fn(&[f64], f64) -> BorderedSolution,
    ) -> BorderedSolution {
        if self.row == row && self.corner == corner {
            return solve(right, last);
        }
        let none = vec![0.0; right.len()];
        let unit = solve(&none, 1.0)?;
        let start = if right == none {
            combination(&(none, 0.0), last, &unit)
        } else {
            solve(right, last)?
        };
        let along = |(unknown, parameter): &(Vec<f64>, f64)| {
            let difference: f64 = row
                .iter()
                .zip(&self.row)
                .zip(unknown)
                .map(|((a, b), u)| (a - b) * u)
                .sum();
            difference + (corner - self.corner) * parameter
        };
        let solution = combination(&start, -along(&start) / (1.0 + along(&unit)), &unit);
        (solution.1.is_finite() && solution.0.iter().all(|u| u.is_finite())).then_some(solution)
    }
}

/// Returns `x + share z`.
fn combination(x: &(Vec<f64>, f64), share: f64, z: &(Vec<f64>, f64)) -> (Vec<f64>, f64) {
    (
        x.0.iter().zip(&z.0).map(|(x, z)| x + share * z).collect(),
        x.1 + share * z.1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three borders of very different units, each checked against the equations.
    #[test]
    fn factors_of_one_border_solve_another() {
        let matrix = Mat::from_fn(2, 2, |i, j| [[0.0, 2.0], [1.0, 0.5]][i][j]);
        let column = [1e-6, 3e-6];
        let first = ([1.0, -1.0], 0.5);
        let (border, factored) = (
            Border::new((&first.0, first.1)),
            Bordered::new(&matrix, &column, (&first.0, first.1)),
        );
        for (row, corner, right, last) in [
            (first.0, first.1, [1.0, 2.0], 3.0),
            ([2e8, 0.0], 40.0, [0.0, 0.0], 1.0),
            ([0.0, 0.0], 1.0, [-1.0, 4.0], 0.0),
        ] {
            let computed = border.other((&row, corner), (&right, last), |right, last| {
                factored.solve(right, last)
            });
            let (x, p) = computed.unwrap_or_default();
            let residual = |i: usize| {
                (0..2).map(|j| matrix[(i, j)] * x[j]).sum::<f64>() + column[i] * p - right[i]
            };
            let bottom = row[0] * x[0] + row[1] * x[1] + corner * p - last;
            assert!(
                residual(0).abs() + residual(1).abs() < 1e-13
                    && bottom.abs() < 1e-13 * (corner * p).abs().max(1.0),
                "{x:?} {p}"
            );
        }
    }
}
