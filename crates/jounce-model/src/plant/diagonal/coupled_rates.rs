//! Equations of a system as the matrix of its physical states.

use crate::plant::{Electrical, System};
use jounce_linalg::Mat;

/// Returns `A` of `x' = A x` for `x = (q, q', V, i)`.
pub(in crate::plant) fn coupled_rates(system: &System, electrical: &Electrical) -> Mat<f64> {
    let (n, nodes) = (system.modes.len(), electrical.nodes.len());
    let size = 2 * n + electrical.len();
    let mut matrix = Mat::zeros(size, size);
    mechanics(system, &mut matrix);
    for (k, node) in electrical.nodes.iter().enumerate() {
        let row = 2 * n + k;
        if let Some(resistance_ohm) = node.resistance_ohm {
            matrix[(row, row)] = -1.0 / (resistance_ohm * node.capacitance_f);
        }
        for (i, coupling) in node.coupling_n_per_v.iter().enumerate() {
            matrix[(n + i, row)] = *coupling;
            matrix[(row, n + i)] = -coupling / node.capacitance_f;
        }
    }
    for (k, inductor) in electrical.inductors.iter().enumerate() {
        let (row, node) = (2 * n + nodes + k, 2 * n + inductor.node);
        matrix[(row, row)] = -inductor.resistance_ohm / inductor.inductance_h;
        matrix[(row, node)] = 1.0 / inductor.inductance_h;
        matrix[(node, row)] = -1.0 / electrical.nodes[inductor.node].capacitance_f;
    }
    for leak in &electrical.leaks {
        let parts = &electrical.patch[leak.patch];
        for (node, share) in parts {
            for (other, factor) in parts {
                let conductance = leak.conductance_per_ohm * share * factor
                    / electrical.nodes[*node].capacitance_f;
                matrix[(2 * n + node, 2 * n + other)] -= conductance;
            }
        }
    }
    matrix
}

/// Writes the rows and columns of the modes.
fn mechanics(system: &System, matrix: &mut Mat<f64>) {
    let (modes, n) = (&system.modes, system.modes.len());
    for i in 0..n {
        let (w, zeta) = (modes.frequency_rad_s[i], modes.damping_ratio[i]);
        matrix[(i, n + i)] = 1.0;
        matrix[(n + i, i)] = -w * w;
        matrix[(n + i, n + i)] = -2.0 * zeta * w;
    }
    for dashpot in &system.dashpots {
        for i in 0..n {
            (0..n).for_each(|j| matrix[(n + i, n + j)] -= dashpot.damping_per_s(i, j));
        }
    }
}
