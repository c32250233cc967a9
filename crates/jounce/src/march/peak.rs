//! Highest value of the polynomial through the nodes of a step.

use super::collocation::{COLLOCATION, NODES, legendre};
use super::lane::Lane;

/// Maximum over the step of the polynomial through the seven nodal values, by golden-section search around the highest node.
pub fn interpolated_peak(values: &Lane) -> f64 {
    let c = &*COLLOCATION;
    let coefficients: [f64; NODES] = std::array::from_fn(|b| (0..NODES).map(|j| c.from_nodal[b][j] * values.0[j]).sum());
    let at = |x: f64| legendre(x, NODES).iter().zip(&coefficients).map(|(p, a)| p * a).sum::<f64>();
    let highest = (0..NODES).max_by(|&i, &j| values.0[i].total_cmp(&values.0[j])).unwrap_or(0);
    let mut low = if highest == 0 { 0.0 } else { c.nodes[highest - 1] };
    let mut high = if highest == NODES - 1 { 1.0 } else { c.nodes[highest + 1] };
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    while high - low > 1e-8 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if at(a) > at(b) { high = b } else { low = a }
    }
    at(0.5 * (low + high)).max(values.0[highest])
}
