//! Charges conserved over a period: on open patches, and on patches behind diodes that never
//! conduct.
//!
//! ```text
//! Q = C V + theta . q,   l M = l,   l = dQ/du
//! ```
//!
//! Each orbit belongs to a family over `Q`, so that `M - I` is singular. The orbit at one
//! prescribed charge is computed, with its stability at that charge. `R + l' (Q - l u)` replaces
//! the residual. `M - l' l` replaces `M`: 0 replaces the multiplier 1, and the others are
//! unchanged.

use jounce_dynamics::Trajectory;
use jounce_linalg::Mat;
use jounce_model::plant::{Conduction, Plant};

/// Returns orthonormal rows that span the conserved charges, in energy coordinates of a scale.
pub fn conserved_charges(
    plant: &Plant,
    scale: &[f64],
    trajectories: &[Trajectory],
) -> Vec<Vec<f64>> {
    let (electrical, first) = (&plant.electrical, 2 * plant.system.modes.len());
    let is_released = |node: usize| {
        let is_at_node = |bridge: &usize| electrical.bridges[*bridge].terminal == node;
        (0..electrical.bridges.len())
            .filter(is_at_node)
            .any(|bridge| {
                trajectories
                    .iter()
                    .any(|trajectory| acts(plant, bridge, trajectory))
            })
    };
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for node in
        (0..electrical.nodes.len()).filter(|node| electrical.is_open(*node) && !is_released(*node))
    {
        let mut row = vec![0.0; scale.len()];
        row[first + node] = electrical.nodes[node].capacitance_f / scale[first + node];
        row.iter_mut()
            .zip(&electrical.nodes[node].coupling_n_per_v)
            .zip(scale)
            .for_each(|((l, theta), w)| *l = theta / w);
        for known in &rows {
            let along: f64 = known.iter().zip(&row).map(|(a, b)| a * b).sum();
            row.iter_mut().zip(known).for_each(|(l, k)| *l -= along * k);
        }
        let length = row.iter().map(|l| l * l).sum::<f64>().sqrt();
        row.iter_mut().for_each(|l| *l /= length);
        rows.push(row);
    }
    rows
}

/// True where the diodes of a bridge conduct or its switch closes.
fn acts(plant: &Plant, bridge: usize, trajectory: &Trajectory) -> bool {
    let conducts = |conduction_state: usize| {
        plant.system.bridge_states(conduction_state)[bridge].conduction != Conduction::Blocked
    };
    trajectory
        .changes()
        .iter()
        .any(|change| change.flipped == Some(bridge) || conducts(change.conduction_state))
        || trajectory
            .segments()
            .iter()
            .any(|segment| conducts(segment.conduction_state))
}

/// Returns a period map with 0 in place of the unit multipliers of some rows.
pub fn without_conserved(map: Mat<f64>, rows: &[Vec<f64>]) -> Mat<f64> {
    rows.iter().fold(map, |map, row| {
        Mat::from_fn(map.nrows(), map.ncols(), |i, j| {
            map[(i, j)] - row[i] * row[j]
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map that conserves `u_1 + u_2` and has the additional multiplier -0.5.
    #[test]
    fn conserved_charge_does_not_change_other_multipliers() {
        let map = Mat::from_fn(2, 2, |i, j| if i == j { 0.25 } else { 0.75 });
        let row = vec![0.5_f64.sqrt(); 2];
        let remaining = without_conserved(map, &[row]);
        let (trace, determinant) = (
            remaining[(0, 0)] + remaining[(1, 1)],
            jounce_linalg::determinant(&remaining),
        );
        assert!((trace + 0.5).abs() < 1e-15 && determinant.abs() < 1e-15);
    }
}
