//! Charge balance of the nodes of a bridge since its diodes last changed, in closed form (see
//! [`jounce_model::plant::Leak`]).

use super::energies::RectifiedEnergies;
use jounce_model::plant::{Plant, PowerOutput};

/// Conduction state of an integration from its start to the current time.
pub(super) struct ChargeBalance<'g> {
    pub plant: &'g Plant,
    /// Change of the physical state.
    pub change: &'g [f64],
    /// Duration, s.
    pub length_s: f64,
    /// Charge drawn by the held current of each regulator, by bridge, C.
    pub drawn_c: &'g [f64],
}

impl ChargeBalance<'_> {
    /// Returns the charge displaced by the motion at a node, C.
    fn displaced_c(&self, node: usize) -> f64 {
        self.plant.electrical.nodes[node]
            .coupling_n_per_v
            .iter()
            .zip(self.change)
            .map(|(theta, q)| theta * q)
            .sum()
    }

    /// Returns `[C V + theta q]` of a node, C.
    pub fn charge_c(&self, node: usize) -> f64 {
        let first = 2 * self.plant.system.modes.len();
        self.plant.electrical.nodes[node].capacitance_f * self.change[first + node]
            + self.displaced_c(node)
    }

    /// Returns the work of the forces that represent the offsets of the voltages of a bridge, J.
    pub fn supplied_j(&self, bridge: usize) -> f64 {
        let electrical = &self.plant.electrical;
        electrical
            .nodes_of(bridge)
            .into_iter()
            .map(|node| electrical.zero_v[node] * self.displaced_c(node))
            .sum()
    }

    /// Returns the time integral of a sum of node voltages of a bridge, `(node, factor)`, relative
    /// to their offsets, V s.
    fn flux_v_s(&self, bridge: usize, parts: &[(usize, f64)]) -> f64 {
        let nodes = self.plant.electrical.nodes_of(bridge);
        let storage = self.plant.electrical.bridges[bridge].storage;
        let drawn_c = |node: usize| match storage == Some(node) {
            true => self.drawn_c.get(bridge).copied().unwrap_or(0.0),
            false => 0.0,
        };
        let gained: Vec<f64> = nodes
            .iter()
            .map(|node| self.charge_c(*node) + drawn_c(*node))
            .collect();
        let flux = self.plant.electrical.flux_v_s(&nodes, &gained);
        let of = |(node, factor): &(usize, f64)| {
            nodes
                .iter()
                .position(|member| member == node)
                .map_or(0.0, |index| factor * flux[index])
        };
        parts.iter().map(of).sum()
    }

    /// Returns the energy of an output beyond the square that its meter counts, because its voltage
    /// has another offset, J.
    pub fn standing_j(&self, output: &PowerOutput) -> f64 {
        let standing_v = output.standing_v;
        if standing_v == 0.0 {
            return 0.0;
        }
        output.conductance_per_ohm
            * standing_v
            * (2.0 * self.flux_v_s(output.bridge, &output.parts) + standing_v * self.length_s)
    }

    /// Returns the charge lost by leakage at the terminal of a bridge, C.
    pub fn leaked_c(&self, bridge: usize) -> f64 {
        let (electrical, terminal) = (
            &self.plant.electrical,
            self.plant.electrical.bridges[bridge].terminal,
        );
        let of = |output: PowerOutput| {
            let factor = output
                .parts
                .iter()
                .find(|(node, _)| *node == terminal)
                .map_or(0.0, |(_, factor)| *factor);
            factor
                * output.conductance_per_ohm
                * (self.flux_v_s(bridge, &output.parts) + output.standing_v * self.length_s)
        };
        if !electrical.leaks_at(terminal) {
            return 0.0;
        }
        self.plant
            .leak_outputs()
            .into_iter()
            .filter(|output| output.bridge == bridge)
            .map(of)
            .sum()
    }

    /// Adds the charge passed by each conducting bridge, and its energies, to those of the rectified
    /// circuits; returns the work of the forces that represent thresholds, J. These do not belong to
    /// the drives.
    pub fn add_conducted(&self, rectified: &mut [RectifiedEnergies]) -> f64 {
        let mut supplied_j = 0.0;
        let bridges = self.plant.system.bridges.iter().enumerate();
        for ((k, bridge), rectified) in bridges.zip(rectified) {
            let sign = bridge.state.conduction.sign();
            if sign == 0.0 {
                continue;
            }
            let charge_c = -sign
                * (self.charge_c(self.plant.electrical.bridges[k].terminal) + self.leaked_c(k));
            rectified.charge_c += charge_c;
            rectified.diodes_j += bridge.drop_v * charge_c;
            rectified.battery_j += (bridge.threshold_v() - bridge.drop_v) * charge_c;
            supplied_j += self.supplied_j(k);
        }
        supplied_j
    }
}
