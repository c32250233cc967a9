//! Nodes of patches that share a circuit, in parallel and in series (see [`Electrical`]).

use crate::plant::system::Connection;
use crate::plant::{Electrical, System};
use crate::structure::PatchModes;
use jounce_spec::Wiring;

/// Coupling of a part, relative to that of its patches, below which it is roundoff.
const ROUNDOFF: f64 = 1e-12;

/// Patches that share a circuit.
struct SharedPatches<'a> {
    /// Number of each patch among all.
    indices: Vec<usize>,
    patches: Vec<&'a PatchModes>,
    /// `-1` for reversed polarity, else `1`.
    signs: Vec<f64>,
    capacitances_f: Vec<f64>,
    modes: usize,
}

impl<'a> SharedPatches<'a> {
    fn of(system: &'a System, connections: &[Connection]) -> Self {
        let patches: Vec<(&String, &PatchModes)> = system.modes.patch.iter().collect();
        // System::assemble has checked that every name exists.
        let members = connections.iter().filter_map(|connection| {
            let index = patches
                .iter()
                .position(|(name, _)| **name == connection.patch)?;
            Some((index, connection.sign))
        });
        let (indices, signs): (Vec<usize>, Vec<f64>) = members.unzip();
        let patches: Vec<&PatchModes> = indices.iter().map(|index| patches[*index].1).collect();
        Self {
            capacitances_f: patches.iter().map(|patch| patch.capacitance_f).collect(),
            indices,
            patches,
            signs,
            modes: system.modes.len(),
        }
    }

    /// Returns the coupling to each mode of a node whose voltage each patch shares, N/V.
    fn coupling_n_per_v(&self, share: &[f64]) -> Vec<f64> {
        let of_mode = |mode: usize| {
            self.patches
                .iter()
                .zip(share)
                .map(|(patch, share)| share * patch.coupling_n_per_v[mode])
                .sum()
        };
        (0..self.modes).map(of_mode).collect()
    }

    /// Returns the capacitance in series, F, and the share of each patch in the voltage.
    fn in_series(&self) -> (f64, Vec<f64>) {
        let capacitance_f = 1.0 / self.capacitances_f.iter().map(|c| 1.0 / c).sum::<f64>();
        let share = self
            .signs
            .iter()
            .zip(&self.capacitances_f)
            .map(|(sign, c)| sign * capacitance_f / c)
            .collect();
        (capacitance_f, share)
    }

    /// Returns capacitance (F), coupling (N/V) and share of each internal voltage in series. Their
    /// number depends only on the number of patches, so that all values of a key of a patch have
    /// the same states.
    fn internal_parts(&self) -> impl Iterator<Item = (f64, Vec<f64>, Vec<f64>)> {
        let size = |values: &[f64]| {
            values
                .iter()
                .fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let driven: f64 = self
            .patches
            .iter()
            .map(|patch| size(&patch.coupling_n_per_v))
            .fold(0.0, f64::max);
        internal_parts(&self.signs, &self.capacitances_f)
            .into_iter()
            .map(move |share| {
                let mut theta = self.coupling_n_per_v(&share);
                if size(&theta) <= ROUNDOFF * driven {
                    theta.fill(0.0);
                }
                let energy = share
                    .iter()
                    .zip(&self.capacitances_f)
                    .map(|(u, c)| c * u * u)
                    .sum();
                (energy, theta, share)
            })
    }
}

impl Electrical {
    /// Adds the nodes of patches; the first is the node of their terminals.
    pub(super) fn connect(
        &mut self,
        system: &System,
        connections: &[Connection],
        wiring: Wiring,
    ) -> usize {
        let shared = SharedPatches::of(system, connections);
        let (capacitance_f, share) = match wiring {
            Wiring::Parallel => (shared.capacitances_f.iter().sum(), shared.signs.clone()),
            Wiring::Series => shared.in_series(),
        };
        let terminal = self.add(capacitance_f, shared.coupling_n_per_v(&share));
        let mut shares = vec![share];
        if wiring == Wiring::Series {
            for (capacitance_f, coupling_n_per_v, share) in shared.internal_parts() {
                self.add(capacitance_f, coupling_n_per_v);
                shares.push(share);
            }
        }
        for (k, index) in shared.indices.iter().enumerate() {
            let parts = shares
                .iter()
                .enumerate()
                .map(|(part, share)| (terminal + part, share[k]));
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
