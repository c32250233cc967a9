//! Newton's linear system, condensed to the nodes in contact.

use super::nodes::Node;
use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

/// `I - J K w - J' K' w` at the nodes, and the two sides of it.
#[derive(Debug)]
pub struct Condensed {
    /// From forces at the nodes to harmonics of the displacement, `G Phi^T w`.
    push: Mat<f64>,
    /// From harmonics of the displacement to forces at the nodes, transposed: `J phi + J' phi'`.
    feel: Mat<f64>,
    matrix: Mat<f64>,
}

impl Condensed {
    /// At the nodes of a motion, with the functions of the sum there in columns; `compliance` up to its last harmonic.
    pub fn new(nodes: &[Node], shapes: &Mat<f64>, compliance: &[c64], step_rad_s: f64) -> Self {
        let (size, count) = (shapes.nrows(), nodes.len());
        let (mut push, mut feel) = (Mat::zeros(size, count), Mat::zeros(size, count));
        for (q, node) in nodes.iter().enumerate() {
            let shape = shapes.col_as_slice(q);
            let push: &mut [f64] = push.col_as_slice_mut(q);
            push.iter_mut().zip(through(compliance, shape)).for_each(|(to, value)| *to = value * node.share);
            let (stiffness, damping) = (node.slopes.stiffness_n_m, node.slopes.damping_n_s_m * step_rad_s);
            let feel: &mut [f64] = feel.col_as_slice_mut(q);
            feel[0] = stiffness;
            for ((n, feel), shape) in feel[1..].chunks_exact_mut(2).enumerate().zip(shape[1..].chunks_exact(2)) {
                let turning = damping * (n + 1) as f64;
                (feel[0], feel[1]) = (stiffness * shape[0] - turning * shape[1], stiffness * shape[1] + turning * shape[0]);
            }
        }
        let matrix = Mat::<f64>::identity(count, count) - feel.transpose() * &push;
        Self { push, feel, matrix }
    }

    /// Solves `[R_u by; row corner] (du, dp) = (right, last)` with `R_u = push feel^T - I`.
    pub fn bordered(&self, by: &[f64], (row, corner): (&[f64], f64), (right, last): (&[f64], f64)) -> Option<(Vec<f64>, f64)> {
        let count = self.matrix.nrows();
        let column = |values: &[f64]| Mat::from_fn(values.len(), 1, |i, _| values[i]);
        let felt = |values: &[f64]| self.feel.transpose() * column(values);
        let (felt_by, felt_right, pushed_row) = (felt(by), felt(right), self.push.transpose() * column(row));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let bottom = dot(row, by) + corner;
        // The border has units of its own: its row and its column are brought to size one.
        let largest = |values: &Mat<f64>, least: f64| values.col(0).iter().fold(least, |max, value| max.max(value.abs()));
        let column_size = largest(&felt_by, f64::MIN_POSITIVE).max(if count == 0 { 1.0 } else { 0.0 });
        let row_size = largest(&pushed_row, (bottom / column_size).abs());
        let matrix = Mat::from_fn(count + 1, count + 1, |i, j| match (i < count, j < count) {
            (true, true) => self.matrix[(i, j)],
            (true, false) => -felt_by[(i, 0)] / column_size,
            (false, true) => pushed_row[(j, 0)] / row_size,
            (false, false) => bottom / (column_size * row_size),
        });
        let sides = Mat::from_fn(count + 1, 1, |i, _| if i < count { -felt_right[(i, 0)] } else { (last + dot(row, right)) / row_size });
        let solution = matrix.partial_piv_lu().solve(&sides);
        let parameter = solution[(count, 0)] / column_size;
        let pushed = &self.push * solution.subrows(0, count);
        let unknown: Vec<f64> = (0..by.len()).map(|k| pushed[(k, 0)] + by[k] * parameter - right[k]).collect();
        (parameter.is_finite() && unknown.iter().all(|u| u.is_finite())).then_some((unknown, parameter))
    }
}

/// Real harmonics of the displacement under those of a force.
pub fn through<'v>(compliance: &'v [c64], force: &'v [f64]) -> impl Iterator<Item = f64> + 'v {
    let pairs = compliance[1..].iter().zip(force[1..].chunks_exact(2));
    std::iter::once(compliance[0].re * force[0]).chain(pairs.flat_map(|(g, f)| [g.re * f[0] + g.im * f[1], g.re * f[1] - g.im * f[0]]))
}
