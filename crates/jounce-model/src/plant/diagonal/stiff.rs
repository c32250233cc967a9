//! Circuits that are too fast to be computed together with the modes.
//!
//! Eigenvectors have a relative error of the roundoff times the spread of the eigenvalues. A
//! circuit `MAX_RATE_RATIO` times faster than the fastest mode leaves about eight digits. Far below
//! that ratio its behaviour is already that of an infinitely fast circuit.

use crate::plant::{Across, Electrical, PlantError, System};

/// Largest ratio of the rate of a circuit to the fastest mode.
const MAX_RATE_RATIO: f64 = 1e8;

/// A key of a circuit that makes it fast if its value is small.
struct StiffKey<'a> {
    circuit: &'a str,
    key: &'static str,
    value: f64,
    unit: &'static str,
    capacitance_f: f64,
    /// The rate is the inverse of the product of value and capacitance, or the root of that
    /// inverse.
    swings: bool,
}

impl StiffKey<'_> {
    fn check(&self, fastest_rad_s: f64) -> Result<(), PlantError> {
        let power = if self.swings { 2.0 } else { 1.0 };
        let time_s = (self.value * self.capacitance_f).powf(1.0 / power);
        let shortest_s = 1.0 / (MAX_RATE_RATIO * fastest_rad_s);
        if time_s >= shortest_s {
            return Ok(());
        }
        Err(PlantError::TooFast {
            circuit: self.circuit.to_string(),
            key: self.key,
            value: self.value,
            unit: self.unit,
            capacitance_f: self.capacitance_f,
            time_s,
            most: MAX_RATE_RATIO,
            mode_hz: fastest_rad_s / std::f64::consts::TAU,
            least: shortest_s.powf(power) / self.capacitance_f,
        })
    }
}

/// Compares each circuit with the fastest retained mode.
///
/// # Errors
/// [`PlantError::TooFast`].
pub fn check_speeds(system: &System, electrical: &Electrical) -> Result<(), PlantError> {
    let fastest_rad_s = system
        .modes
        .frequency_rad_s
        .iter()
        .fold(0.0, |max: f64, w| max.max(*w));
    if fastest_rad_s == 0.0 {
        return Ok(());
    }
    for (load, across) in system.loads.iter().zip(&electrical.load) {
        let Some(across) = across else { continue };
        let (node, is_across) = match across {
            Across::Node(node) => (*node, true),
            Across::Inductor(inductor, _) => (electrical.inductors[*inductor].node, false),
        };
        let (circuit, capacitance_f) = (load.name.as_str(), electrical.nodes[node].capacitance_f);
        if is_across {
            let value = load.resistance_ohm;
            StiffKey {
                circuit,
                key: "resistance",
                value,
                unit: "ohm",
                capacitance_f,
                swings: false,
            }
            .check(fastest_rad_s)?;
        }
        if let Some((value, _)) = load.inductor {
            StiffKey {
                circuit,
                key: "inductance",
                value,
                unit: "H",
                capacitance_f,
                swings: true,
            }
            .check(fastest_rad_s)?;
        }
    }
    for link in &electrical.links {
        let (bridge, capacitance_f) = (
            &system.bridges[link.bridge],
            electrical.nodes[link.node].capacitance_f,
        );
        let (circuit, value) = (bridge.name.as_str(), bridge.diode_ohm);
        StiffKey {
            circuit,
            key: "diode_resistance",
            value,
            unit: "ohm",
            capacitance_f,
            swings: false,
        }
        .check(fastest_rad_s)?;
    }
    Ok(())
}
