//! What the nodes of a bridge have gained since its diodes last changed, and what has flowed meanwhile: in closed form (see
//! [`crate::plant::Leak`]).

use crate::plant::{Plant, PowerOutput};

/// A regime of a march from its start to the present time.
pub(super) struct ChargeBalance<'g> {
    pub plant: &'g Plant,
    /// Change of the physical state.
    pub moved: &'g [f64],
    /// How long it has lasted, s.
    pub length_s: f64,
}

impl ChargeBalance<'_> {
    /// Charge that the motion has displaced at a node, C.
    fn displaced_c(&self, node: usize) -> f64 {
        self.plant.electrical.nodes[node]
            .coupling_n_per_v
            .iter()
            .zip(self.moved)
            .map(|(theta, q)| theta * q)
            .sum()
    }

    /// `[C V + theta q]` of a node, C.
    pub fn charge_c(&self, node: usize) -> f64 {
        let first = 2 * self.plant.system.modes.len();
        self.plant.electrical.nodes[node].capacitance_f * self.moved[first + node]
            + self.displaced_c(node)
    }

    /// Work of the forces by which the zeros of the voltages of a bridge enter, J.
    pub fn pushed_j(&self, bridge: usize) -> f64 {
        let electrical = &self.plant.electrical;
        electrical
            .nodes_of(bridge)
            .into_iter()
            .map(|node| electrical.zero_v[node] * self.displaced_c(node))
            .sum()
    }

    /// Integral over time of a sum of node voltages of a bridge, `(node, factor)`, counted from their zeros, V s.
    fn flux_v_s(&self, bridge: usize, parts: &[(usize, f64)]) -> f64 {
        let nodes = self.plant.electrical.nodes_of(bridge);
        let gained: Vec<f64> = nodes.iter().map(|node| self.charge_c(*node)).collect();
        let flux = self.plant.electrical.flux_v_s(&nodes, &gained);
        let of = |(node, factor): &(usize, f64)| {
            nodes
                .iter()
                .position(|own| own == node)
                .map_or(0.0, |place| factor * flux[place])
        };
        parts.iter().map(of).sum()
    }

    /// What an output takes beyond the square that its meter counts, because its voltage is counted from another zero, J.
    pub fn standing_j(&self, output: &PowerOutput) -> f64 {
        let standing_v = output.standing_v;
        if standing_v == 0.0 {
            return 0.0;
        }
        output.conductance_per_ohm
            * standing_v
            * (2.0 * self.flux_v_s(output.bridge, &output.parts) + standing_v * self.length_s)
    }

    /// Charge that leakage has taken out of the terminal of a bridge, C.
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
}
