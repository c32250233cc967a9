//! Nodes of patches that share a circuit, in parallel and in series (see [`Electrical`]).

use crate::plant::system::Connection;
use crate::plant::{Electrical, System};
use jounce_spec::Wiring;

/// Largest relative coupling of a part, to that of its patches, below which the part is omitted.
const MIN_DRIVEN_SHARE: f64 = 1e-12;

impl Electrical {
    /// Adds the nodes of patches; the first is the node of their terminals.
    pub(super) fn connect(
        &mut self,
        system: &System,
        connections: &[Connection],
        wiring: Wiring,
    ) -> usize {
        let names: Vec<&String> = system.modes.patch.keys().collect();
        // System::assemble has checked that every name exists.
        let members: Vec<(usize, f64)> = (connections.iter())
            .filter_map(|connection| {
                Some((
                    names.iter().position(|name| **name == connection.patch)?,
                    connection.sign,
                ))
            })
            .collect();
        let patches: Vec<_> = members
            .iter()
            .filter_map(|(index, _)| system.modes.patch.get(names[*index]))
            .collect();
        let coupling = |share: &[f64]| -> Vec<f64> {
            let of_mode = |mode: usize| {
                patches
                    .iter()
                    .zip(share)
                    .map(|(patch, share)| share * patch.coupling_n_per_v[mode])
                    .sum()
            };
            (0..system.modes.len()).map(of_mode).collect()
        };
        let leaks = patches.iter().any(|patch| patch.leakage_ohm.is_some());
        let signs: Vec<f64> = members.iter().map(|(_, sign)| *sign).collect();
        let capacitances_f: Vec<f64> = patches.iter().map(|patch| patch.capacitance_f).collect();
        let terminal = match wiring {
            Wiring::Parallel => self.add(capacitances_f.iter().sum(), coupling(&signs)),
            Wiring::Series => {
                let capacitance_f = 1.0 / capacitances_f.iter().map(|c| 1.0 / c).sum::<f64>();
                let share: Vec<f64> = signs
                    .iter()
                    .zip(&capacitances_f)
                    .map(|(sign, c)| sign * capacitance_f / c)
                    .collect();
                self.add(capacitance_f, coupling(&share))
            }
        };
        let (nodes, mut shares) = (self.nodes.len(), vec![signs.clone()]);
        if wiring == Wiring::Series {
            shares[0] = signs
                .iter()
                .zip(&capacitances_f)
                .map(|(sign, c)| sign * self.nodes[terminal].capacitance_f / c)
                .collect();
            for share in internal_parts(&signs, &capacitances_f) {
                let theta = coupling(&share);
                let size = |values: &[f64]| {
                    values
                        .iter()
                        .fold(0.0_f64, |most, value| most.max(value.abs()))
                };
                let driven: f64 = patches
                    .iter()
                    .map(|patch| size(&patch.coupling_n_per_v))
                    .fold(0.0, f64::max);
                if leaks || size(&theta) > MIN_DRIVEN_SHARE * driven {
                    let energy: f64 = share
                        .iter()
                        .zip(&capacitances_f)
                        .map(|(u, c)| c * u * u)
                        .sum();
                    self.add(energy, theta);
                    shares.push(share);
                }
            }
        }
        for (k, (index, _)) in members.iter().enumerate() {
            let parts = shares.iter().enumerate().map(|(part, share)| {
                (
                    if part == 0 {
                        terminal
                    } else {
                        nodes + part - 1
                    },
                    share[k],
                )
            });
            self.patch[*index] = parts.filter(|(_, factor)| *factor != 0.0).collect();
        }
        terminal
    }
}

/// Returns voltages of patches in series that sum to zero at the terminals, orthogonal to each
/// other in energy (Gram-Schmidt).
fn internal_parts(signs: &[f64], capacitances_f: &[f64]) -> Vec<Vec<f64>> {
    let dot = |a: &[f64], b: &[f64]| {
        a.iter()
            .zip(b)
            .zip(capacitances_f)
            .map(|((a, b), c)| a * b * c)
            .sum::<f64>()
    };
    let mut parts: Vec<Vec<f64>> = Vec::new();
    for k in 1..signs.len() {
        let mut part = vec![0.0; signs.len()];
        (part[k - 1], part[k]) = (signs[k - 1], -signs[k]);
        for before in &parts {
            let share = dot(&part, before) / dot(before, before);
            part.iter_mut()
                .zip(before)
                .for_each(|(value, b)| *value -= share * b);
        }
        parts.push(part);
    }
    parts
}
