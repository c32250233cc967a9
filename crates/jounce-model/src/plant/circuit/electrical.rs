//! Electrical states: capacitive nodes and inductor currents.
//!
//! ```text
//! C_n V_n' + V_n / R_n + sum_(inductors at n) i + sum_i theta_in q_i' = 0,      L i' = V_n - r i
//! ```
//!
//! An open patch is a node. Patches in parallel share one: `C = sum C_p`, `theta = sum s_p theta_p`
//! (`s_p` the sign of the connection). Patches in series carry one current; their voltages split
//! into the terminal voltage `V = sum s_p V_p` with
//!
//! ```text
//! 1 / C = sum 1 / C_p,      theta = C sum s_p theta_p / C_p,      V_p = s_p (C / C_p) V + ...
//! ```
//!
//! and parts that are energy-orthogonal to it, which no current changes; each is a separate open
//! node. A part that no motion drives (the two equal layers of a bimorph) has the coupling 0 and
//! keeps its charge.

use super::leak::Leak;
use crate::plant::system::{Connection, Load};
use crate::plant::{Bridge, System};
use jounce_spec::Wiring;

/// Electrical states of a system.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Electrical {
    /// Capacitive nodes.
    pub nodes: Vec<ElectricalNode>,
    /// Inductors.
    pub inductors: Vec<Inductor>,
    /// Voltage of each patch (in the order of `modes.patch`) as a sum of node voltages: `(node,
    /// factor)`.
    pub patch: Vec<Vec<(usize, f64)>>,
    /// Location of the voltage across the resistor of each load (in the order of `loads`); `None`
    /// for a load without a patch.
    pub load: Vec<Option<Across>>,
    /// Conducting diodes.
    pub links: Vec<Conductance>,
    /// Leaking patches, in the order of `modes.patch`.
    pub leaks: Vec<Leak>,
    /// Nodes of each bridge, in the order of `bridges`.
    pub bridges: Vec<BridgeNodes>,
    /// Zero of the voltage of each node, V.
    pub zero_v: Vec<f64>,
}

/// A conductance from one node to another, or to its own zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductance {
    /// Index of the bridge.
    pub bridge: usize,
    /// From this node ...
    pub node: usize,
    /// ... to this node times this sign.
    pub to: Option<(usize, f64)>,
    /// Conductance, 1/ohm.
    pub conductance_per_ohm: f64,
}

/// Nodes of a bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BridgeNodes {
    /// Patches.
    pub terminal: usize,
    /// Storage capacitor.
    pub storage: Option<usize>,
}

/// One capacitive node.
#[derive(Debug, Clone, PartialEq)]
pub struct ElectricalNode {
    /// Capacitance, F.
    pub capacitance_f: f64,
    /// Modal coupling, N/V per unit modal coordinate.
    pub coupling_n_per_v: Vec<f64>,
    /// Resistance across the node, ohm; `None` without.
    pub resistance_ohm: Option<f64>,
}

/// An inductor across a node, with a resistor in series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inductor {
    /// Index of the node.
    pub node: usize,
    /// Inductance, H.
    pub inductance_h: f64,
    /// Resistance in series, ohm.
    pub resistance_ohm: f64,
}

/// Location of the voltage across a resistor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Across {
    /// The voltage of a node.
    Node(usize),
    /// The current of an inductor times this resistance, ohm.
    Inductor(usize, f64),
}

impl Electrical {
    /// Returns the nodes and inductors of a system, in the order of its patches.
    pub fn of(system: &System) -> Self {
        let patches = &system.modes.patch;
        let mut electrical = Self {
            patch: vec![Vec::new(); patches.len()],
            ..Self::default()
        };
        let mut connected: Vec<Option<Across>> = vec![None; system.loads.len()];
        let mut terminals: Vec<Option<usize>> = vec![None; system.bridges.len()];
        let carries = |connections: &[Connection], name: &str| {
            connections
                .iter()
                .any(|connection| connection.patch == name)
        };
        for (index, (name, patch)) in patches.iter().enumerate() {
            let load = system
                .loads
                .iter()
                .position(|load| carries(&load.connections, name));
            let bridge = system
                .bridges
                .iter()
                .position(|bridge| carries(&bridge.connections, name));
            match (load, bridge) {
                (None, None) => {
                    let node = electrical.add(patch.capacitance_f, patch.coupling_n_per_v.clone());
                    electrical.patch[index].push((node, 1.0));
                }
                (Some(load), _) if connected[load].is_none() => {
                    let component = &system.loads[load];
                    let terminal =
                        electrical.connect(system, &component.connections, component.wiring);
                    connected[load] = Some(electrical.across(terminal, component));
                }
                (None, Some(bridge)) if terminals[bridge].is_none() => {
                    let component = &system.bridges[bridge];
                    terminals[bridge] =
                        Some(electrical.connect(system, &component.connections, component.wiring));
                }
                _ => {}
            }
        }
        electrical.load = connected;
        electrical.leak(system);
        for (number, (bridge, terminal)) in system.bridges.iter().zip(terminals).enumerate() {
            // System::assemble has checked that every bridge has a patch.
            electrical.rectify(number, bridge, terminal.unwrap_or(0), system.modes.len());
        }
        electrical.zero_v.resize(electrical.nodes.len(), 0.0);
        for (number, bridge) in system.bridges.iter().enumerate() {
            let threshold_v = bridge.state.conduction.sign() * bridge.threshold_v();
            electrical
                .standing_v(number, threshold_v)
                .into_iter()
                .for_each(|(node, voltage)| electrical.zero_v[node] = voltage);
        }
        electrical
    }

    /// Adds the storage of a bridge, and the conducting path.
    fn rectify(&mut self, number: usize, bridge: &Bridge, terminal: usize, modes: usize) {
        let storage = bridge.storage.capacitance_f().map(|capacitance_f| {
            let node = self.add(capacitance_f, vec![0.0; modes]);
            let leakage_per_ohm = bridge.leakage_ohm.map_or(0.0, |leakage| 1.0 / leakage);
            let conductance_per_ohm = bridge.storage.conductance_per_ohm() + leakage_per_ohm;
            self.nodes[node].resistance_ohm = Some(1.0 / conductance_per_ohm);
            node
        });
        self.bridges.push(BridgeNodes { terminal, storage });
        let sign = bridge.state.conduction.sign();
        if sign != 0.0 {
            let to = storage.map(|node| (node, sign));
            self.links.push(Conductance {
                bridge: number,
                node: terminal,
                to,
                conductance_per_ohm: 1.0 / bridge.diode_ohm,
            });
        }
    }

    /// Returns the number of states.
    pub fn len(&self) -> usize {
        self.nodes.len() + self.inductors.len()
    }

    /// True without patches.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True for a node of constant charge `C V + theta . q`.
    pub fn is_open(&self, node: usize) -> bool {
        self.nodes[node].resistance_ohm.is_none()
            && !self.leaks_at(node)
            && self.inductors.iter().all(|inductor| inductor.node != node)
            && self.links.iter().all(|link| link.node != node)
    }

    /// Returns the factor of each electrical state whose square is twice its energy: `sqrt(C)`,
    /// `sqrt(L)`.
    pub fn energy_scale(&self) -> impl Iterator<Item = f64> {
        let nodes = self.nodes.iter().map(|node| node.capacitance_f.sqrt());
        nodes.chain(
            self.inductors
                .iter()
                .map(|inductor| inductor.inductance_h.sqrt()),
        )
    }

    pub(in crate::plant) fn add(
        &mut self,
        capacitance_f: f64,
        coupling_n_per_v: Vec<f64>,
    ) -> usize {
        self.nodes.push(ElectricalNode {
            capacitance_f,
            coupling_n_per_v,
            resistance_ohm: None,
        });
        self.nodes.len() - 1
    }

    fn across(&mut self, node: usize, load: &Load) -> Across {
        match load.inductor {
            Some((inductance_h, Wiring::Series)) => {
                self.inductors.push(Inductor {
                    node,
                    inductance_h,
                    resistance_ohm: load.resistance_ohm,
                });
                Across::Inductor(self.inductors.len() - 1, load.resistance_ohm)
            }
            Some((inductance_h, Wiring::Parallel)) => {
                self.inductors.push(Inductor {
                    node,
                    inductance_h,
                    resistance_ohm: 0.0,
                });
                self.nodes[node].resistance_ohm = Some(load.resistance_ohm);
                Across::Node(node)
            }
            None => {
                self.nodes[node].resistance_ohm = Some(load.resistance_ohm);
                Across::Node(node)
            }
        }
    }
}
