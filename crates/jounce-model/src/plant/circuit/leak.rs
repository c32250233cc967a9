//! Leakage of patches: a resistance across each capacitance.
//!
//! The voltage of a patch is a sum of node voltages, `V_p = sum_n f_pn V_n`. Its leakage therefore
//! draws the current `sum_m G_nm V_m` from node `n`, with `G_nm = f_pn f_pm / R_p`. With all
//! conductances of a bridge the nodes obey
//!
//! ```text
//! C V' + K V + theta q' = k,       K z = k
//! ```
//!
//! where `k` comes from the threshold of its diodes. Voltages are measured from `z`, so only the
//! structure is forced. The integral over a time follows from the charge that the nodes have
//! gained: `integral (V - z) dt = -K^-1 [C V + theta q]`.

use crate::plant::{Electrical, System};
use jounce_linalg::Mat;

/// Leakage resistance across a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leak {
    /// Index of the patch, in the order of `modes.patch`.
    pub patch: usize,
    /// Conductance, 1/ohm.
    pub conductance_per_ohm: f64,
}

impl Electrical {
    /// Adds the leakage of every leaking patch.
    pub(in crate::plant) fn leak(&mut self, system: &System) {
        let patches = system.modes.patch.values().enumerate();
        self.leaks = patches
            .filter_map(|(patch, patch_data)| {
                Some(Leak {
                    patch,
                    conductance_per_ohm: 1.0 / patch_data.leakage_ohm?,
                })
            })
            .collect();
    }

    /// True if a leaking patch depends on the voltage of a node.
    pub fn leaks_at(&self, node: usize) -> bool {
        self.leaks.iter().any(|leak| {
            self.patch[leak.patch]
                .iter()
                .any(|(other, _)| *other == node)
        })
    }

    /// Returns the pairs of nodes that a leakage couples.
    pub(in crate::plant) fn leaking_pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.leaks.iter().flat_map(|leak| {
            self.patch[leak.patch]
                .windows(2)
                .map(|pair| (pair[0].0, pair[1].0))
        })
    }

    /// Returns the nodes of a bridge: its patches, the parts between them, its storage.
    pub fn nodes_of(&self, bridge: usize) -> Vec<usize> {
        let bridge_nodes = self.bridges[bridge];
        let mut nodes = vec![bridge_nodes.terminal];
        for parts in self
            .patch
            .iter()
            .filter(|parts| parts.iter().any(|(node, _)| *node == bridge_nodes.terminal))
        {
            nodes.extend(parts.iter().map(|(node, _)| *node));
        }
        nodes.extend(bridge_nodes.storage);
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Returns `K` of some nodes, 1/ohm.
    fn conductances(&self, nodes: &[usize]) -> Mat<f64> {
        let mut matrix = Mat::zeros(nodes.len(), nodes.len());
        let mut across = |parts: &[(usize, f64)], conductance: f64| {
            let factors: Vec<(usize, f64)> = parts
                .iter()
                .filter_map(|(node, factor)| {
                    Some((
                        nodes.iter().position(|of_bridge| of_bridge == node)?,
                        *factor,
                    ))
                })
                .collect();
            for (i, a) in &factors {
                for (j, b) in &factors {
                    matrix[(*i, *j)] += conductance * a * b;
                }
            }
        };
        for (node, electrical_node) in self.nodes.iter().enumerate() {
            if let Some(resistance_ohm) = electrical_node.resistance_ohm {
                across(&[(node, 1.0)], 1.0 / resistance_ohm);
            }
        }
        self.leaks
            .iter()
            .for_each(|leak| across(&self.patch[leak.patch], leak.conductance_per_ohm));
        for link in &self.links {
            let parts: Vec<(usize, f64)> = std::iter::once((link.node, 1.0))
                .chain(link.to.map(|(node, sign)| (node, -sign)))
                .collect();
            across(&parts, link.conductance_per_ohm);
        }
        matrix
    }

    /// Returns `K^-1` times a current into each of some nodes, V.
    fn voltages(&self, nodes: &[usize], current_a: &[f64]) -> Vec<f64> {
        // An isolated charge makes K singular, and no current reaches it.
        let Some(inverse) = jounce_linalg::pseudoinverse(&self.conductances(nodes)) else {
            return vec![f64::NAN; nodes.len()];
        };
        (0..nodes.len())
            .map(|i| {
                current_a
                    .iter()
                    .enumerate()
                    .map(|(j, current)| inverse[(i, j)] * current)
                    .sum()
            })
            .collect()
    }

    /// Returns the equilibrium voltages of the nodes of a bridge whose diodes conduct against a
    /// threshold, without motion: `(node, V)`.
    pub(super) fn standing_v(&self, bridge: usize, threshold_v: f64) -> Vec<(usize, f64)> {
        let Some(link) = self.links.iter().find(|link| link.bridge == bridge) else {
            return Vec::new();
        };
        let nodes = self.nodes_of(bridge);
        if !nodes.iter().any(|node| self.leaks_at(*node)) {
            return vec![(link.node, threshold_v)];
        }
        let offset_a = link.conductance_per_ohm * threshold_v;
        let into = |node: &usize| match link.to {
            _ if *node == link.node => offset_a,
            Some((other, sign)) if *node == other => -sign * offset_a,
            _ => 0.0,
        };
        let current_a: Vec<f64> = nodes.iter().map(into).collect();
        self.voltages(&nodes, &current_a)
            .into_iter()
            .zip(&nodes)
            .map(|(voltage, node)| (*node, voltage))
            .collect()
    }

    /// Returns `integral (V - z) dt` of some nodes, V s, from the charge `[C V + theta q]` gained
    /// by each, C.
    pub fn flux_v_s(&self, nodes: &[usize], gained_c: &[f64]) -> Vec<f64> {
        let into: Vec<f64> = gained_c.iter().map(|charge| -charge).collect();
        self.voltages(nodes, &into)
    }
}
