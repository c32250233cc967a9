//! Expected numbers of an example.

use crate::example::G_M_S2;
pub use crate::example::{plant, spec};
pub use crate::rows::check;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::Plant;

/// Voltage of the load per g of the base, V zero to peak.
pub fn voltage_per_g(plant: &Plant, frequency_hz: f64) -> f64 {
    let responses = frf(
        plant,
        &FrfInput::BaseAcceleration,
        &[FrfOutput::LoadVoltage("load".into())],
        &[frequency_hz],
    )
    .unwrap();
    responses[0].value[0].norm() * G_M_S2
}

/// Frequency and value of the highest voltage per g between two frequencies, by golden section.
pub fn peak(plant: &Plant, mut low_hz: f64, mut high_hz: f64) -> (f64, f64) {
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    while high_hz - low_hz > 1e-7 * high_hz {
        let (one, two) = (
            high_hz - golden * (high_hz - low_hz),
            low_hz + golden * (high_hz - low_hz),
        );
        if voltage_per_g(plant, one) > voltage_per_g(plant, two) {
            high_hz = two
        } else {
            low_hz = one
        }
    }
    (low_hz, voltage_per_g(plant, low_hz))
}

/// Best resistance at a frequency and the peak voltage squared over it, from `V (1/R + Y) = I` at
/// two resistances.
pub fn best_resistance(make: impl Fn(&str) -> Plant, frequency_hz: f64) -> (f64, f64) {
    let voltage = |ohm: f64| {
        let plant = make(&format!("{ohm} ohm"));
        frf(
            &plant,
            &FrfInput::BaseAcceleration,
            &[FrfOutput::LoadVoltage("load".into())],
            &[frequency_hz],
        )
        .unwrap()[0]
            .value[0]
            * G_M_S2
    };
    let (r1, r2) = (1e4, 1e5);
    let (v1, v2) = (voltage(r1), voltage(r2));
    let admittance = (v2 / r2 - v1 / r1) / (v1 - v2);
    let best = 1.0 / admittance.norm();
    (best, voltage(best).norm_sqr() / best)
}
