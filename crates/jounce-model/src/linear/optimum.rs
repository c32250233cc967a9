//! Steady power and the load with the largest power.

use crate::plant::{Plant, PlantError};

/// Optimal resistance under a fixed drive.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Optimum {
    /// Resistance, ohm.
    pub resistance_ohm: f64,
    /// Mean power there, W.
    pub mean_power_w: f64,
}

/// Returns the mean power of all loads under the drives of a plant, without contact, W.
pub fn steady_power_w(plant: &Plant) -> f64 {
    let mut power_w = 0.0;
    for (index, load) in plant.system.loads.iter().enumerate() {
        let row = plant.load_voltage_row(index);
        for tone in &plant.tones {
            power_w += 0.5 * crate::plant::dot(&row, &tone.steady).norm_sqr() / load.resistance_ohm;
        }
    }
    power_w
}

/// Returns the resistance of load number `load` with the largest steady mean power, others
/// unchanged.
///
/// With one tone the voltage is `V = I / (1 / R + Y)`, with `I` and `Y` independent of `R`. Then
/// `P = |I|^2 R / (2 |1 + R Y|^2)` has its only maximum at `R = 1 / |Y|` (Thevenin).
///
/// # Errors
/// [`PlantError`] of the plants at two trial resistances.
pub fn optimal_resistance(plant: &Plant, load: usize) -> Result<Optimum, PlantError> {
    let voltage = |resistance_ohm: f64| -> Result<jounce_linalg::c64, PlantError> {
        let mut system = plant.system.clone();
        system.loads[load].resistance_ohm = resistance_ohm;
        let plant = Plant::new(system)?;
        Ok(plant
            .tones
            .first()
            .map_or(jounce_linalg::c64::new(0.0, 0.0), |tone| {
                crate::plant::dot(&plant.load_voltage_row(load), &tone.steady)
            }))
    };
    // V (1/R + Y) = I at two resistances gives Y.
    let (r1, r2) = (
        plant.system.loads[load].resistance_ohm,
        2.0 * plant.system.loads[load].resistance_ohm,
    );
    let (v1, v2) = (voltage(r1)?, voltage(r2)?);
    let admittance = (v2 / r2 - v1 / r1) / (v1 - v2);
    let resistance_ohm = 1.0 / admittance.norm();
    let power = 0.5 * voltage(resistance_ohm)?.norm_sqr() / resistance_ohm;
    Ok(Optimum {
        resistance_ohm,
        mean_power_w: power,
    })
}
