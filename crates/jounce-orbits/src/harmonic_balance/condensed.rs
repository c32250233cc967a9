//! Linear system of Newton, condensed to the nodes in contact.

use super::compliance::PortCompliance;
use super::compliance_table::{ComplianceTable, NodePlaces};
use super::motion::{complex, rotated};
use super::nodes::ContactQuadrature;
use crate::bordered::border::{Border, BorderedSolution};
use jounce_linalg::{LuFactors, Mat, column_mut};

/// `I - J K w - J' K' w` at the nodes with the first requested border, factored.
#[derive(Debug)]
pub struct Condensed {
    factors: LuFactors,
    /// First border, unscaled.
    first: Border,
    /// Sizes of its row and its column, because the border has its own units.
    row_size: f64,
    column_size: f64,
}

/// Nodes of all stops with the compliance between them. Values at the nodes are ordered stop by
/// stop.
#[derive(Debug, Clone, Copy)]
pub struct CoupledNodes<'b> {
    /// Nodes of each stop.
    pub each: &'b [ContactQuadrature],
    /// Compliance up to the last harmonic.
    pub between: &'b PortCompliance,
    /// `w / p`, rad/s.
    pub step_rad_s: f64,
}

impl CoupledNodes<'_> {
    /// Returns the number of nodes of all stops.
    fn count(&self) -> usize {
        self.each.iter().map(|side| side.nodes.len()).sum()
    }

    /// Returns the forces at the nodes for harmonics of the displacements, `J phi + J' phi'`.
    fn node_forces(&self, harmonics: &[f64]) -> Vec<f64> {
        let mut node_forces = Vec::with_capacity(self.count());
        for (side, block) in self
            .each
            .iter()
            .zip(harmonics.chunks_exact(self.between.size()))
        {
            let block = complex(block);
            let (values, rates) = if is_damped(side) {
                let [values, rates] = side
                    .angles
                    .values([&block, &rotated(&block, self.step_rad_s)]);
                (values, rates)
            } else {
                let [values] = side.angles.values([&block]);
                let none = vec![0.0; values.len()];
                (values, none)
            };
            let forces = values.iter().zip(&rates).zip(&side.nodes);
            node_forces.extend(forces.map(|((value, rate), node)| {
                node.slopes.stiffness_n_m * value + node.slopes.damping_n_s_m * rate
            }));
        }
        node_forces
    }

    /// Returns the nodes of a stop in grid points of a response.
    fn node_positions(&self, side: &ContactQuadrature, response: &ComplianceTable) -> NodePlaces {
        let damped = if is_damped(side) {
            &side.nodes[..]
        } else {
            &[]
        };
        NodePlaces {
            at: side
                .nodes
                .iter()
                .map(|node| response.point_index(node.angle))
                .collect(),
            stiffness_n_m: side
                .nodes
                .iter()
                .map(|node| node.slopes.stiffness_n_m)
                .collect(),
            damping_n_m: damped
                .iter()
                .map(|node| node.slopes.damping_n_s_m * self.step_rad_s)
                .collect(),
        }
    }

    /// Returns the harmonics of the displacements for forces at the nodes, `G phi^T w`.
    fn apply(&self, mut forces_n: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut add_block = |side: &ContactQuadrature| {
            let weights: Vec<f64> = side
                .nodes
                .iter()
                .zip(&mut forces_n)
                .map(|(node, force_n)| force_n * node.share)
                .collect();
            side.gathered(&weights, self.between.harmonics())
        };
        self.between
            .apply(&self.each.iter().map(&mut add_block).collect::<Vec<_>>())
    }

    /// Applies the transpose of [`Self::apply`].
    fn apply_adjoint(&self, row: &[f64]) -> Vec<f64> {
        let mut pulled = Vec::with_capacity(self.count());
        for (side, back) in self.each.iter().zip(self.between.apply_adjoint(row)) {
            let [values] = side.angles.values([&back]);
            pulled.extend(
                values
                    .iter()
                    .zip(&side.nodes)
                    .map(|(value, node)| value * node.share),
            );
        }
        pulled
    }
}

/// True where the force of a stop depends on the rate.
fn is_damped(side: &ContactQuadrature) -> bool {
    side.nodes
        .iter()
        .any(|node| node.slopes.damping_n_s_m != 0.0)
}

impl Condensed {
    /// Factors the system at nodes with tabulated responses of every pair of ports, row by row, and
    /// the border `[R_u by; row corner]`; `None` where the matrix is not finite.
    pub fn new(
        sides: CoupledNodes<'_>,
        responses: &[ComplianceTable],
        by: &[f64],
        (row, corner): (&[f64], f64),
    ) -> Option<Self> {
        let (count, stops) = (sides.count(), sides.each.len());
        let (node_forces, pulled) = (sides.node_forces(by), sides.apply_adjoint(row));
        let first = Border::new((row, corner));
        let bottom = first.along(by) + corner;
        let largest = |values: &[f64], least: f64| {
            values.iter().fold(least, |max, value| max.max(value.abs()))
        };
        let column_size =
            largest(&node_forces, f64::MIN_POSITIVE).max(if count == 0 { 1.0 } else { 0.0 });
        let row_size = largest(&pulled, (bottom / column_size).abs());
        let positions: Vec<NodePlaces> = sides
            .each
            .iter()
            .zip(responses)
            .map(|(side, response)| sides.node_positions(side, response))
            .collect();
        let mut matrix = Mat::<f64>::zeros(count + 1, count + 1);
        let pushing = sides.each.iter().zip(&positions).enumerate();
        let pushing = pushing.flat_map(|(b, (side, positions))| {
            positions
                .at
                .iter()
                .zip(&side.nodes)
                .map(move |(position, node)| (b, *position, node.share))
        });
        for (p, ((b, force, share), pulled)) in pushing.zip(&pulled).enumerate() {
            let column = column_mut(&mut matrix, p);
            let mut rest = &mut column[..];
            for (a, positions) in positions.iter().enumerate() {
                let (rows, after) = rest.split_at_mut(positions.at.len());
                responses[a * stops + b].column(force, -share, positions, rows);
                rest = after;
            }
            column[p] += 1.0;
            column[count] = pulled / row_size;
        }
        let border = column_mut(&mut matrix, count);
        border
            .iter_mut()
            .zip(&node_forces)
            .for_each(|(entry, node_force)| *entry = -node_force / column_size);
        border[count] = bottom / (column_size * row_size);
        let is_finite = row_size.is_finite() && column_size.is_finite();
        is_finite.then(|| Self {
            factors: LuFactors::of(&matrix),
            first,
            row_size,
            column_size,
        })
    }

    /// Solves `[R_u by; row corner] (du, dp) = (right, last)`; `R_u` is the derivative of the
    /// residual with respect to the harmonics of the displacements.
    ///
    /// The factors belong to the first border.
    pub fn bordered(
        &self,
        sides: CoupledNodes<'_>,
        by: &[f64],
        border: (&[f64], f64),
        right: (&[f64], f64),
    ) -> BorderedSolution {
        self.first.other(border, right, |right, last| {
            self.solve(sides, by, right, last)
        })
    }

    fn solve(
        &self,
        sides: CoupledNodes<'_>,
        by: &[f64],
        right: &[f64],
        last: f64,
    ) -> BorderedSolution {
        let count = sides.count();
        let node_forces = if right.iter().all(|r| *r == 0.0) {
            vec![0.0; count]
        } else {
            sides.node_forces(right)
        };
        let bottom = (last + self.first.along(right)) / self.row_size;
        let mut solution: Vec<f64> = node_forces
            .iter()
            .map(|node_force| -node_force)
            .chain([bottom])
            .collect();
        self.factors.solve(&mut solution);
        let parameter = solution[count] / self.column_size;
        let solved = sides.apply(solution[..count].iter().copied());
        let unknown: Vec<f64> = solved
            .iter()
            .zip(by)
            .zip(right)
            .map(|((value, by), right)| value + by * parameter - right)
            .collect();
        (parameter.is_finite() && unknown.iter().all(|u| u.is_finite()))
            .then_some((unknown, parameter))
    }
}
