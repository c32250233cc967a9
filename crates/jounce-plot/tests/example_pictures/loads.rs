//! Curves over the load resistance.

use crate::example::G_M_S2;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::Plant;
use jounce_plot::{LineDirection, SweepLine};

/// Magnitude of a response per g of the base.
pub fn per_g(plant: &Plant, response: FrfOutput, frequency_hz: &[f64]) -> Vec<f64> {
    let responses = frf(
        plant,
        &FrfInput::BaseAcceleration,
        &[response],
        frequency_hz,
    )
    .unwrap();
    responses[0]
        .value
        .iter()
        .map(|value| value.norm() * G_M_S2)
        .collect()
}

/// Mean power in the load per g squared of the base, W.
pub fn power_per_g2(plant: &Plant, frequency_hz: f64, resistance_ohm: f64) -> f64 {
    let voltage = per_g(
        plant,
        FrfOutput::LoadVoltage("load".into()),
        &[frequency_hz],
    )[0];
    0.5 * voltage * voltage / resistance_ohm
}

/// `count` values from `low` to `high`, evenly spaced on a logarithmic axis.
pub fn logarithmic_range(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| low * (high / low).powf(k as f64 / (count - 1) as f64))
        .collect()
}

/// Curve over resistances, each as text for a spec.
pub fn over_resistance(
    label: &str,
    resistance_ohm: &[f64],
    power: impl Fn(f64, &str) -> f64,
) -> SweepLine {
    let value = resistance_ohm
        .iter()
        .map(|ohm| power(*ohm, &format!("{ohm:e} ohm")))
        .collect();
    SweepLine {
        label: label.into(),
        direction: LineDirection::Independent,
        parameter: resistance_ohm.to_vec(),
        value,
        settled: Vec::new(),
    }
}
