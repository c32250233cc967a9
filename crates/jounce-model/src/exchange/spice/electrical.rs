//! Electrodes and loads.

use crate::plant::{Across, Electrical, System};

/// Clamped capacitances with the currents of the modes, leakages, loads and the power of each load.
pub(super) fn nodes(system: &System, electrical: &Electrical) -> Vec<String> {
    let mut lines = vec![String::new(), "* Electrodes and loads".to_owned()];
    for (index, node) in electrical.nodes.iter().enumerate() {
        let number = index + 1;
        lines.push(format!("Ce{number} e{number} 0 {:e}", node.capacitance_f));
        for (mode, coupling) in node.coupling_n_per_v.iter().enumerate() {
            if *coupling != 0.0 {
                lines.push(format!(
                    "F{number}_{0} e{number} 0 Vmode{0} {coupling:e}",
                    mode + 1
                ));
            }
        }
        match node.resistance_ohm {
            Some(resistance_ohm) => {
                lines.push(format!("Re{number} e{number} 0 {resistance_ohm:e}"))
            }
            // SPICE requires a path to the ground; its conductance is negligible.
            None => lines.push(format!("Re{number} e{number} 0 1e18")),
        }
    }
    lines.extend(leaks(electrical));
    lines.extend(inductors(electrical));
    lines.extend(powers(system, electrical));
    lines
}

/// Currents of the leakages, which may couple nodes.
fn leaks(electrical: &Electrical) -> Vec<String> {
    let mut lines = Vec::new();
    for leak in &electrical.leaks {
        for (from, from_factor) in &electrical.patch[leak.patch] {
            for (to, to_factor) in &electrical.patch[leak.patch] {
                let conductance = leak.conductance_per_ohm * from_factor * to_factor;
                lines.push(format!(
                    "Gleak{0}_{1}_{2} e{1} 0 e{2} 0 {conductance:e}",
                    leak.patch + 1,
                    from + 1,
                    to + 1
                ));
            }
        }
    }
    lines
}

fn inductors(electrical: &Electrical) -> Vec<String> {
    let mut lines = Vec::new();
    for (index, inductor) in electrical.inductors.iter().enumerate() {
        let (number, node) = (index + 1, inductor.node + 1);
        lines.push(format!("Vcoil{number} e{node} k{number} 0"));
        lines.push(format!(
            "Lcoil{number} k{number} r{number} {:e}",
            inductor.inductance_h
        ));
        match inductor.resistance_ohm > 0.0 {
            true => lines.push(format!(
                "Rcoil{number} r{number} 0 {:e}",
                inductor.resistance_ohm
            )),
            false => lines.push(format!("V0coil{number} r{number} 0 0")),
        }
    }
    lines
}

/// Power of each load, as a voltage.
fn powers(system: &System, electrical: &Electrical) -> Vec<String> {
    let mut lines = Vec::new();
    for (index, (load, across)) in system.loads.iter().zip(&electrical.load).enumerate() {
        let power = match across {
            Some(Across::Node(node)) => format!("v(e{})^2/{:e}", node + 1, load.resistance_ohm),
            Some(Across::Inductor(coil, resistance_ohm)) => {
                format!("i(Vcoil{})^2*{resistance_ohm:e}", coil + 1)
            }
            None => "0".to_owned(),
        };
        lines.push(format!(
            "Bpower{0} power{0} 0 v = {power} ; W in {1}",
            index + 1,
            load.name
        ));
    }
    lines
}
