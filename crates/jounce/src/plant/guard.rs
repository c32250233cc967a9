//! What is watched and metered of a bridge: outputs of the plant.

use super::{Bridge, Conduction, Plant, Port, Scheme, Storage, System};

/// What changes a bridge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// Diodes begin to conduct.
    Conducts(Conduction),
    /// They end.
    Blocks,
    /// The switch closes for an instant.
    Switches,
}

/// An output of the plant whose way up through zero changes a bridge.
#[derive(Debug, Clone, PartialEq)]
pub struct Guard {
    /// Number of the bridge.
    pub bridge: usize,
    /// What it changes.
    pub change: Change,
}

/// Where a bridge gives energy to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outlet {
    /// The load across the storage capacitor.
    Load,
    /// The leakage across it.
    Leakage,
    /// The resistance of the diodes.
    Diodes,
}

impl Bridge {
    /// What may change it next.
    pub fn changes(&self) -> Vec<Change> {
        let diodes = matches!(self.scheme, Scheme::Standard | Scheme::ParallelSshi { .. });
        let mut changes = match self.state.conduction {
            Conduction::Blocked if diodes => vec![Change::Conducts(Conduction::Positive), Change::Conducts(Conduction::Negative)],
            Conduction::Blocked => Vec::new(),
            Conduction::Positive | Conduction::Negative => vec![Change::Blocks],
        };
        if self.has_switch() {
            changes.push(Change::Switches);
        }
        changes
    }
}

impl System {
    /// What may change its bridges next.
    pub(super) fn guards(&self) -> Vec<Guard> {
        let of =
            |(bridge, own): (usize, &Bridge)| own.changes().into_iter().map(move |change| Guard { bridge, change }).collect::<Vec<_>>();
        self.bridges.iter().enumerate().flat_map(of).collect()
    }
}

impl Plant {
    /// A port that no force acts on; its displacement is what the guard watches, in V or kg^1/2 m/s times N/V.
    pub(super) fn guard_port(&self, guard: &Guard) -> Port {
        let (bridge, nodes) = (&self.system.bridges[guard.bridge], self.electrical.bridges[guard.bridge]);
        let (first, n) = (2 * self.system.modes.len(), self.system.modes.len());
        let mut physical = vec![0.0; self.len()];
        let mut across = |sign: f64, factor: f64| {
            physical[first + nodes.terminal] = factor * sign;
            if let Some(storage) = nodes.storage {
                physical[first + storage] = -factor;
            }
            // The voltage of the patches is counted from its threshold while they conduct.
            factor * bridge.threshold_v() - factor * sign * self.electrical.zero_v[nodes.terminal]
        };
        let gap_m = match guard.change {
            Change::Conducts(to) => across(to.sign(), 1.0),
            Change::Blocks => across(bridge.state.conduction.sign(), -1.0),
            Change::Switches => {
                let sign = if bridge.state.rising { -1.0 } else { 1.0 };
                let coupling = &self.electrical.nodes[nodes.terminal].coupling_n_per_v;
                coupling.iter().enumerate().for_each(|(i, theta)| physical[n + i] = sign * theta);
                0.0
            }
        };
        let displacement = self.row(&physical, 0);
        Port {
            steady_m: self.steady_output(&displacement),
            velocity: self.diagonal.block.rate_row(&displacement),
            force: vec![0.0; self.len()],
            mobility_per_kg: 1.0,
            displacement,
            gap_m,
        }
    }

    /// Outputs of the bridges whose squares are powers: bridge, kind, conductance (1/ohm), row.
    pub fn bridge_outputs(&self) -> Vec<(usize, Outlet, f64, Vec<f64>)> {
        let first = 2 * self.system.modes.len();
        let mut outputs = Vec::new();
        for (k, (bridge, nodes)) in self.system.bridges.iter().zip(&self.electrical.bridges).enumerate() {
            if let (Some(storage), Storage::Capacitor { load_ohm, .. }) = (nodes.storage, bridge.storage) {
                let row = self.row(&[1.0], first + storage);
                outputs.push((k, Outlet::Load, 1.0 / load_ohm, row.clone()));
                outputs.extend(bridge.leakage_ohm.map(|leakage_ohm| (k, Outlet::Leakage, 1.0 / leakage_ohm, row)));
            }
        }
        for link in &self.electrical.links {
            let mut physical = vec![0.0; self.len()];
            physical[first + link.node] = 1.0;
            link.to.iter().for_each(|(other, sign)| physical[first + other] = -sign);
            outputs.push((link.bridge, Outlet::Diodes, link.conductance_per_ohm, self.row(&physical, 0)));
        }
        outputs
    }
}
