//! Events and metered outputs of a bridge, as outputs of the plant.

use crate::plant::{
    Bridge, Conduction, Leak, Plant, Port, RectifierScheme, Regulator, System, VoltageBand,
};

/// Event that changes a bridge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BridgeChange {
    /// Diodes start to conduct.
    Conducts(Conduction),
    /// Diodes stop conducting.
    Blocks,
    /// The switch closes for an instant.
    Switches,
    /// The storage voltage passes the upper limit of the band of its regulator.
    Rises,
    /// The storage voltage passes the lower limit of the band of its regulator.
    Falls,
}

/// An output of the plant whose upward zero crossing changes a bridge.
#[derive(Debug, Clone, PartialEq)]
pub struct EventFunction {
    /// Index of the bridge.
    pub bridge: usize,
    /// Change of the bridge.
    pub change: BridgeChange,
}

/// Destination of the energy of a bridge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EnergyOutlet {
    /// The load across the storage capacitor.
    Load,
    /// The regulator while it is off, and the same conductance while it is on.
    Regulator,
    /// The leakage resistance across it.
    Leakage,
    /// The resistance of the diodes.
    Diodes,
    /// The leakage resistance across a patch.
    Patch,
}

/// A voltage whose square times a conductance is a power.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerOutput {
    /// Index of the bridge; out of range if the output belongs to no bridge.
    pub bridge: usize,
    /// Destination of the energy.
    pub outlet: EnergyOutlet,
    /// Conductance, 1/ohm.
    pub conductance_per_ohm: f64,
    /// Row of the voltage less `standing_v`, block coordinates.
    pub row: Vec<f64>,
    /// This voltage as a sum of node voltages: `(node, factor)`.
    pub parts: Vec<(usize, f64)>,
    /// Voltage when every node is at its own zero, V.
    pub standing_v: f64,
}

impl Bridge {
    /// Returns the possible next changes of the bridge.
    pub fn changes(&self) -> Vec<BridgeChange> {
        let diodes = matches!(
            self.scheme,
            RectifierScheme::Standard | RectifierScheme::ParallelSshi { .. }
        );
        let mut changes = match self.state.conduction {
            Conduction::Blocked if diodes => {
                vec![
                    BridgeChange::Conducts(Conduction::Positive),
                    BridgeChange::Conducts(Conduction::Negative),
                ]
            }
            Conduction::Blocked => Vec::new(),
            Conduction::Positive | Conduction::Negative => vec![BridgeChange::Blocks],
        };
        if self.has_switch() {
            changes.push(BridgeChange::Switches);
        }
        if self.regulator().is_some() {
            changes.extend([BridgeChange::Rises, BridgeChange::Falls]);
        }
        changes
    }
}

impl System {
    /// Returns the event functions of the possible next changes of its bridges.
    pub(in crate::plant) fn guards(&self) -> Vec<EventFunction> {
        let of = |(bridge, state): (usize, &Bridge)| {
            state
                .changes()
                .into_iter()
                .map(move |change| EventFunction { bridge, change })
                .collect::<Vec<_>>()
        };
        self.bridges.iter().enumerate().flat_map(of).collect()
    }
}

impl Plant {
    /// Returns a port without force; its displacement is the value of the event function, in V or
    /// kg^1/2 m/s times N/V.
    pub(in crate::plant) fn guard_port(&self, guard: &EventFunction) -> Port {
        let (bridge, nodes) = (
            &self.system.bridges[guard.bridge],
            self.electrical.bridges[guard.bridge],
        );
        let (first, n) = (2 * self.system.modes.len(), self.system.modes.len());
        let mut physical = vec![0.0; self.len()];
        let across = |physical: &mut Vec<f64>, sign: f64, factor: f64| {
            physical[first + nodes.terminal] = factor * sign;
            if let Some(storage) = nodes.storage {
                physical[first + storage] = -factor;
            }
            // Voltages are measured from their equilibrium at the threshold of conducting diodes.
            let zero_v = &self.electrical.zero_v;
            factor * bridge.threshold_v() - factor * sign * zero_v[nodes.terminal]
                + nodes
                    .storage
                    .map_or(0.0, |storage| factor * zero_v[storage])
        };
        let regulated = |physical: &mut Vec<f64>, factor: f64| {
            if let Some(storage) = nodes.storage {
                physical[first + storage] = factor;
            }
            let off = bridge.regulator().map(Regulator::off_band);
            off.map_or(f64::INFINITY, |band| self.band_gap(guard, &band))
        };
        let gap_m = match guard.change {
            BridgeChange::Rises => regulated(&mut physical, 1.0),
            BridgeChange::Falls => regulated(&mut physical, -1.0),
            BridgeChange::Conducts(to) => across(&mut physical, to.sign(), 1.0),
            BridgeChange::Blocks => across(&mut physical, bridge.state.conduction.sign(), -1.0),
            BridgeChange::Switches => {
                let sign = if bridge.state.rising { -1.0 } else { 1.0 };
                let coupling = &self.electrical.nodes[nodes.terminal].coupling_n_per_v;
                coupling
                    .iter()
                    .enumerate()
                    .for_each(|(i, theta)| physical[n + i] = sign * theta);
                0.0
            }
        };
        let displacement = self.row(&physical, 0);
        Port {
            steady_m: self.steady_output(&displacement),
            approach_m: vec![Default::default(); self.tones.len()],
            approach: Vec::new(),
            velocity: self.diagonal.block.rate_row(&displacement),
            force: vec![0.0; self.len()],
            mobility_per_kg: 1.0,
            displacement,
            gap_m,
        }
    }

    /// Returns the threshold of an event of a regulator, V, in the measure of its port.
    pub fn band_gap(&self, guard: &EventFunction, band: &VoltageBand) -> f64 {
        let storage = self.electrical.bridges[guard.bridge].storage;
        let zero_v = storage.map_or(0.0, |storage| self.electrical.zero_v[storage]);
        match guard.change {
            BridgeChange::Falls => zero_v - band.low_v,
            _ => band.high_v - zero_v,
        }
    }

    /// Returns the outputs of the bridges whose squares are powers.
    pub fn bridge_outputs(&self) -> Vec<PowerOutput> {
        let mut outputs = Vec::new();
        for (k, (bridge, nodes)) in self
            .system
            .bridges
            .iter()
            .zip(&self.electrical.bridges)
            .enumerate()
        {
            if let Some(storage) = nodes.storage {
                let output = |outlet, conductance| {
                    self.output((k, outlet), conductance, vec![(storage, 1.0)], 0.0)
                };
                let outlet = match bridge.regulator() {
                    Some(_) => EnergyOutlet::Regulator,
                    None => EnergyOutlet::Load,
                };
                outputs.push(output(outlet, bridge.storage.conductance_per_ohm()));
                outputs.extend(
                    bridge
                        .leakage_ohm
                        .map(|leakage_ohm| output(EnergyOutlet::Leakage, 1.0 / leakage_ohm)),
                );
            }
        }
        for link in &self.electrical.links {
            let bridge = &self.system.bridges[link.bridge];
            let parts = std::iter::once((link.node, 1.0))
                .chain(link.to.map(|(other, sign)| (other, -sign)))
                .collect();
            let against_v = bridge.state.conduction.sign() * bridge.threshold_v();
            outputs.push(self.output(
                (link.bridge, EnergyOutlet::Diodes),
                link.conductance_per_ohm,
                parts,
                against_v,
            ));
        }
        outputs
    }

    /// Returns the outputs whose squares are the leakage powers of patches, in the order of
    /// `electrical.leaks`.
    pub fn leak_outputs(&self) -> Vec<PowerOutput> {
        let bridge_of = |node: usize| {
            (0..self.system.bridges.len())
                .find(|bridge| self.electrical.nodes_of(*bridge).contains(&node))
        };
        let output = |leak: &Leak| {
            let parts = self.electrical.patch[leak.patch].clone();
            let bridge = parts
                .first()
                .and_then(|(node, _)| bridge_of(*node))
                .unwrap_or(usize::MAX);
            self.output(
                (bridge, EnergyOutlet::Patch),
                leak.conductance_per_ohm,
                parts,
                0.0,
            )
        };
        self.electrical.leaks.iter().map(output).collect()
    }

    fn output(
        &self,
        (bridge, outlet): (usize, EnergyOutlet),
        conductance_per_ohm: f64,
        parts: Vec<(usize, f64)>,
        against_v: f64,
    ) -> PowerOutput {
        let mut physical = vec![0.0; self.len()];
        parts
            .iter()
            .for_each(|(node, factor)| physical[2 * self.system.modes.len() + node] += factor);
        let standing_v = parts
            .iter()
            .map(|(node, factor)| factor * self.electrical.zero_v[*node])
            .sum::<f64>()
            - against_v;
        PowerOutput {
            bridge,
            outlet,
            conductance_per_ohm,
            row: self.row(&physical, 0),
            parts,
            standing_v,
        }
    }
}
