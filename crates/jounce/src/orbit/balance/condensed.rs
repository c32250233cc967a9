//! Newton's linear system, condensed to the nodes in contact.

use super::angles::Angles;
use super::motion::{complex, harmonics, real, through, turned};
use super::nodes::Node;
use super::response::Response;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, c64};

/// `I - J K w - J' K' w` at the nodes with the border that was asked for first, factored.
#[derive(Debug)]
pub struct Condensed {
    factors: PartialPivLu<f64>,
    /// The border as it was given.
    row: Vec<f64>,
    corner: f64,
    /// Sizes of its row and its column: it has units of its own.
    row_size: f64,
    column_size: f64,
}

/// The nodes and the plant between them.
#[derive(Debug, Clone, Copy)]
pub struct Sides<'b> {
    /// The nodes.
    pub nodes: &'b [Node],
    /// Their angles.
    pub angles: &'b Angles,
    /// Up to the last harmonic.
    pub compliance: &'b [c64],
    /// `w / p`, rad/s.
    pub step_rad_s: f64,
}

impl Sides<'_> {
    /// Forces at the nodes per harmonics of the displacement, `J phi + J' phi'`.
    fn felt(&self, harmonics: &[f64]) -> Vec<f64> {
        let own = complex(harmonics);
        let (values, rates) = if self.are_damped() {
            let [values, rates] = self.angles.values([&own, &turned(&own, self.step_rad_s)]);
            (values, rates)
        } else {
            let [values] = self.angles.values([&own]);
            let none = vec![0.0; values.len()];
            (values, none)
        };
        let slopes = self.nodes.iter().map(|node| node.slopes);
        let forces = values.iter().zip(&rates).zip(slopes);
        forces.map(|((value, rate), slopes)| slopes.stiffness_n_m * value + slopes.damping_n_s_m * rate).collect()
    }

    /// True where the force depends on the rate.
    fn are_damped(&self) -> bool {
        self.nodes.iter().any(|node| node.slopes.damping_n_s_m != 0.0)
    }

    /// Harmonics of the displacement per forces at the nodes, `G phi^T w`.
    fn pushed(&self, forces: impl Iterator<Item = f64>) -> Vec<f64> {
        let weights: Vec<f64> = forces.zip(self.nodes).map(|(force, node)| force * node.share).collect();
        let moments = self.angles.moments(&weights, self.compliance.len() - 1);
        real(&through(self.compliance, &harmonics(&moments)))
    }

    /// The transpose of [`Self::pushed`].
    fn pulled(&self, row: &[f64]) -> Vec<f64> {
        let back: Vec<c64> = complex(row).iter().zip(self.compliance).map(|(r, g)| r * g.conj()).collect();
        let [values] = self.angles.values([&back]);
        values.iter().zip(self.nodes).map(|(value, node)| value * node.share).collect()
    }
}

impl Condensed {
    /// At nodes between which the plant responds by `response`, with the border `[R_u by; row corner]`; `None` where that is not finite.
    pub fn new(sides: Sides<'_>, response: &Response, by: &[f64], (row, corner): (&[f64], f64)) -> Option<Self> {
        let count = sides.nodes.len();
        let places: Vec<f64> = sides.nodes.iter().map(|node| response.place(node.angle)).collect();
        let (felt, pulled) = (sides.felt(by), sides.pulled(row));
        let bottom = dot(row, by) + corner;
        let largest = |values: &[f64], least: f64| values.iter().fold(least, |max, value| max.max(value.abs()));
        let column_size = largest(&felt, f64::MIN_POSITIVE).max(if count == 0 { 1.0 } else { 0.0 });
        let row_size = largest(&pulled, (bottom / column_size).abs());
        let damped = sides.are_damped();
        let mut matrix = Mat::<f64>::zeros(count + 1, count + 1);
        for (p, ((force, from), pulled)) in places.iter().zip(sides.nodes).zip(&pulled).enumerate() {
            let column: &mut [f64] = matrix.col_as_slice_mut(p);
            for ((entry, displacement), to) in column.iter_mut().zip(&places).zip(sides.nodes) {
                let moved = if damped {
                    let (value, slope) = response.value_and_slope(*force, *displacement);
                    to.slopes.stiffness_n_m * value + to.slopes.damping_n_s_m * sides.step_rad_s * slope
                } else {
                    to.slopes.stiffness_n_m * response.value(*force, *displacement)
                };
                *entry = -from.share * moved;
            }
            column[p] += 1.0;
            column[count] = pulled / row_size;
        }
        let border: &mut [f64] = matrix.col_as_slice_mut(count);
        border.iter_mut().zip(&felt).for_each(|(entry, felt)| *entry = -felt / column_size);
        border[count] = bottom / (column_size * row_size);
        let is_finite = row_size.is_finite() && column_size.is_finite();
        is_finite.then(|| Self { factors: matrix.partial_piv_lu(), row: row.to_vec(), corner, row_size, column_size })
    }

    /// Solves `[R_u by; row corner] (du, dp) = (right, last)` with `R_u = push feel^T - I`.
    ///
    /// The factors are those of the border that came first, `B`. Another row differs from it by `e v^T`, `e` being the last unit vector:
    /// `(B + e v^T)^-1 r = x - z (v x) / (1 + v z)` with `B x = r`, `B z = e`.
    pub fn bordered(
        &self,
        sides: Sides<'_>,
        by: &[f64],
        (row, corner): (&[f64], f64),
        (right, last): (&[f64], f64),
    ) -> Option<(Vec<f64>, f64)> {
        if self.row == row && self.corner == corner {
            return self.solve(sides, by, right, last);
        }
        let none = vec![0.0; right.len()];
        let unit = self.solve(sides, by, &none, 1.0)?;
        let start = if right == none { moved(&(none, 0.0), last, &unit) } else { self.solve(sides, by, right, last)? };
        let along = |(unknown, parameter): &(Vec<f64>, f64)| {
            let apart: f64 = row.iter().zip(&self.row).zip(unknown).map(|((a, b), u)| (a - b) * u).sum();
            apart + (corner - self.corner) * parameter
        };
        let found = moved(&start, -along(&start) / (1.0 + along(&unit)), &unit);
        (found.1.is_finite() && found.0.iter().all(|u| u.is_finite())).then_some(found)
    }

    fn solve(&self, sides: Sides<'_>, by: &[f64], right: &[f64], last: f64) -> Option<(Vec<f64>, f64)> {
        let count = sides.nodes.len();
        let felt = if right.iter().all(|r| *r == 0.0) { vec![0.0; count] } else { sides.felt(right) };
        let bottom = (last + dot(&self.row, right)) / self.row_size;
        let given = Mat::from_fn(count + 1, 1, |i, _| if i < count { -felt[i] } else { bottom });
        let solution = self.factors.solve(&given);
        let parameter = solution[(count, 0)] / self.column_size;
        let pushed = sides.pushed((0..count).map(|q| solution[(q, 0)]));
        let unknown: Vec<f64> = pushed.iter().zip(by).zip(right).map(|((pushed, by), right)| pushed + by * parameter - right).collect();
        (parameter.is_finite() && unknown.iter().all(|u| u.is_finite())).then_some((unknown, parameter))
    }
}

/// `x + share z`.
fn moved(x: &(Vec<f64>, f64), share: f64, z: &(Vec<f64>, f64)) -> (Vec<f64>, f64) {
    (x.0.iter().zip(&z.0).map(|(x, z)| x + share * z).collect(), x.1 + share * z.1)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
