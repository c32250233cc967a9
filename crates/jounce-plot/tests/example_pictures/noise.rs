//! `white-noise-adhikari-2009`: mean power against the load, with and without an inductor.

use crate::comparison::check;
use crate::example::plant;
use crate::loads::{logarithmic_range, over_resistance};
use jounce_model::linear::white_noise_powers_w;
use jounce_plot::power_against_resistance;
use std::f64::consts::PI;

#[test]
fn power_with_and_without_an_inductor() {
    const EXAMPLE: &str = "white-noise-adhikari-2009";
    // Two-sided density of the paper, 1 per rad/s, as a one-sided density per Hz.
    let density = 4.0 * PI;
    let resistance_ohm = logarithmic_range(1e3, 1e7, 81);
    let power = |words: &str, inductance: Option<&str>| {
        let mut settings = vec![("circuit.load.resistance", words)];
        settings.extend(inductance.map(|inductance| ("circuit.load.inductance", inductance)));
        white_noise_powers_w(&plant(EXAMPLE, &settings), density).unwrap()[0]
    };
    let lines = [
        over_resistance("resistor", &resistance_ohm, |_, words| power(words, None)),
        over_resistance("with a tuned inductor", &resistance_ohm, |_, words| {
            power(words, Some("51.73000567214974 H"))
        }),
    ];
    let title = "Mean power under white noise of 1 (m/s²)² per rad/s, two-sided";
    check(
        EXAMPLE,
        "power",
        &power_against_resistance(title, "W", &lines),
    );
}
