//! `examples/white-noise-adhikari-2009`: Adhikari, Friswell and Inman, Smart Mater. Struct. 18
//! (2009) 115005.

use crate::expected::{check, plant};
use jounce_model::linear::{noise_powers_between_w, white_noise_powers_w};
use std::f64::consts::{PI, TAU};

const EXAMPLE: &str = "white-noise-adhikari-2009";
/// Two-sided density of the paper, 1 per rad/s, as a one-sided density per Hz.
const DENSITY: f64 = 4.0 * PI;
const MASS_KG: f64 = 9.12e-3;
const CAPACITANCE_F: f64 = 4.3e-8;

fn frequency_rad_s() -> f64 {
    (4.1e3_f64 / MASS_KG).sqrt()
}

fn damping_ratio() -> f64 {
    0.218 / (2.0 * (4.1e3 * MASS_KG).sqrt())
}

fn coupling_squared() -> f64 {
    4.57e-3_f64.powi(2) / (4.1e3 * CAPACITANCE_F)
}

/// Mean power of the plant by the Lyapunov equation and by the spectral integral, W.
fn powers(resistance_ohm: f64, inductance_h: Option<f64>) -> [f64; 2] {
    let resistance = format!("{resistance_ohm:e} ohm");
    let inductance = inductance_h.map(|inductance_h| format!("{inductance_h:e} H"));
    let mut settings = vec![("circuit.load.resistance", resistance.as_str())];
    settings.extend(
        inductance
            .as_deref()
            .map(|inductance| ("circuit.load.inductance", inductance)),
    );
    let plant = plant(EXAMPLE, &settings);
    [
        white_noise_powers_w(&plant, DENSITY).unwrap()[0],
        noise_powers_between_w(&plant, DENSITY, [0.0, f64::INFINITY]).unwrap()[0],
    ]
}

/// Section 3 of the paper: no inductor.
fn without_inductor(alpha: f64) -> f64 {
    let (zeta, k) = (damping_ratio(), coupling_squared());
    PI * MASS_KG * alpha * k
        / ((2.0 * zeta * alpha * alpha + alpha) * k
            + 4.0 * zeta * zeta * alpha
            + 2.0 * (alpha * alpha + 1.0) * zeta)
}

/// Section 4 of the paper: inductor in parallel.
fn with_inductor(alpha: f64, beta: f64) -> f64 {
    let (zeta, k) = (damping_ratio(), coupling_squared());
    let lead = beta + 2.0 * alpha * zeta;
    let below = beta * lead * (1.0 + 2.0 * alpha * zeta) * (alpha * k + 2.0 * zeta)
        + 2.0 * alpha * alpha * zeta * (beta - 1.0).powi(2);
    PI * MASS_KG * alpha * beta * k * lead / below
}

/// Measured: Lyapunov 1e-14, spectral integral 3e-13.
#[test]
fn both_methods_are_the_closed_form() {
    let ohm = |alpha: f64| alpha / (frequency_rad_s() * CAPACITANCE_F);
    let henry = |beta: f64| beta / (frequency_rad_s().powi(2) * CAPACITANCE_F);
    for alpha in [0.05, 0.864936, 3.0, 40.0] {
        for power in powers(ohm(alpha), None) {
            assert!(
                (power / without_inductor(alpha) - 1.0).abs() < 1e-8,
                "{alpha}: {power}"
            );
        }
        for beta in [0.2, 1.0, 1.3, 25.0] {
            for power in powers(ohm(alpha), Some(henry(beta))) {
                assert!(
                    (power / with_inductor(alpha, beta) - 1.0).abs() < 1e-8,
                    "{alpha} {beta}: {power}"
                );
            }
        }
    }
}

#[test]
fn every_expected_row_is_met() {
    let scale = frequency_rad_s() * CAPACITANCE_F;
    let tuned_h = 1.0 / (frequency_rad_s().powi(2) * CAPACITANCE_F);
    let best_ohm = 1.0 / (1.0 + coupling_squared()).sqrt() / scale;
    // It is a maximum: both neighbours give less.
    let best = powers(best_ohm, None)[0];
    assert!(powers(0.99 * best_ohm, None)[0] < best && powers(1.01 * best_ohm, None)[0] < best);
    check(
        EXAMPLE,
        &[
            ("power_w", powers(3e4, None)[0]),
            ("best_resistance_ohm", best_ohm),
            ("best_power_w", best),
            ("tuned_inductor_power_w", powers(3e4, Some(tuned_h))[0]),
            (
                "best_tuned_inductor_power_w",
                powers(1.0 / coupling_squared().sqrt() / scale, Some(tuned_h))[0],
            ),
        ],
    );
}

/// Bands sum to the total, and the half-power band of the resonance contains most of it.
#[test]
fn bands_add_up() {
    let plant = plant(EXAMPLE, &[]);
    let band = |low, high| noise_powers_between_w(&plant, DENSITY, [low, high]).unwrap()[0];
    let natural_hz = frequency_rad_s() / TAU;
    let parts = band(0.0, 100.0) + band(100.0, 115.0) + band(115.0, f64::INFINITY);
    assert!((parts / band(0.0, f64::INFINITY) - 1.0).abs() < 1e-9);
    assert!(band(0.8 * natural_hz, 1.2 * natural_hz) > 0.8 * parts);
}
