//! Patches of a circuit that cancel each other because of their polarity.

use super::Warning;
use jounce_model::plant::{Connection, Plant};
use jounce_spec::Wiring;

/// Coupling of a mode, relative to the largest of a circuit, below which it is roundoff.
const ROUNDOFF: f64 = 1e-9;

/// Returns a warning for each circuit of several patches that together give less than the strongest
/// of them alone, in every mode. The terminal voltage of the open circuit is the sum of these terms
/// over its patches, times a common factor:
///
/// ```text
/// parallel: s_p theta_p,   series: s_p theta_p / C_p
/// ```
pub(super) fn cancelling(plant: &Plant) -> Vec<Warning> {
    let system = &plant.system;
    let loads = system.loads.iter();
    let bridges = system.bridges.iter();
    loads
        .map(|load| (&load.name, &load.connections, load.wiring))
        .chain(bridges.map(|bridge| (&bridge.name, &bridge.connections, bridge.wiring)))
        .filter_map(|(name, connections, wiring)| {
            let reversed = reversed(plant, connections, wiring)?;
            Some(Warning::Cancelling {
                circuit: name.clone(),
                patches: connections.iter().map(written).collect(),
                reversed: reversed.iter().map(written).collect(),
            })
        })
        .collect()
}

/// Returns the connections with which no patch acts against the first one in the lowest mode that
/// drives them, if they cancel in every mode as they are.
fn reversed(plant: &Plant, connections: &[Connection], wiring: Wiring) -> Option<Vec<Connection>> {
    let modes = &plant.system.modes;
    let term = |connection: &Connection, mode: usize| {
        let patch = &modes.patch[&connection.patch];
        let theta = connection.sign * patch.coupling_n_per_v[mode];
        match wiring {
            Wiring::Parallel => theta,
            Wiring::Series => theta / patch.capacitance_f,
        }
    };
    let strongest = |mode: usize| {
        let sizes = connections.iter().map(|own| term(own, mode).abs());
        sizes.fold(0.0, f64::max)
    };
    let largest = (0..modes.len()).map(strongest).fold(0.0, f64::max);
    let driven = || (0..modes.len()).filter(|mode| strongest(*mode) > ROUNDOFF * largest);
    let sum = |mode: usize| connections.iter().map(|own| term(own, mode)).sum::<f64>();
    let lowest = driven().next()?;
    driven()
        .all(|mode| sum(mode).abs() < strongest(mode))
        .then(|| {
            let first = term(&connections[0], lowest);
            let turned = connections.iter().map(|own| Connection {
                sign: own.sign * (first * term(own, lowest)).signum(),
                ..own.clone()
            });
            turned.collect()
        })
}

/// Returns a connection as the spec names it.
fn written(connection: &Connection) -> String {
    let minus = if connection.sign < 0.0 { "-" } else { "" };
    format!("{minus}{}", connection.patch)
}
