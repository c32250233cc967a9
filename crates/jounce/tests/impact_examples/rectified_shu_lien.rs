//! `rectified-shu-lien-2006`: an oscillator behind a full bridge.

use crate::{example, rows};
use jounce::linear::Input;
use jounce::plant::{Plant, PlantError, System};
use std::f64::consts::PI;

const EXAMPLE: &str = "rectified-shu-lien-2006";

/// `P / (F^2 / (w M))` by the formula of Shu and Lien (2006), with `r = C w R` and the frequency ratio.
fn formula(squared_coupling: f64, damping_ratio: f64, ratio: f64, r: f64) -> f64 {
    let shared = r * ratio + PI / 2.0;
    let damping = (2.0 * damping_ratio + 2.0 * squared_coupling * r / shared.powi(2)) * ratio;
    let stiffness = 1.0 - ratio * ratio + ratio * squared_coupling * r / shared;
    squared_coupling * ratio * ratio * r / shared.powi(2) / (damping * damping + stiffness * stiffness)
}

#[test]
fn the_power_is_that_of_direct_integration() {
    let (_, answer) = example::run(EXAMPLE, "harvester.toml", &[]);
    rows::check(EXAMPLE, &[("power_w", answer.mean_power_w), ("formula_w", formula(0.3, 0.02, 1.05, 0.420236))]);
    assert!(answer.energies.residual_relative().abs() < 1e-8);
}

#[test]
fn what_does_not_go_together_is_told() {
    for (key, value, told) in [
        ("circuit.rectifier.efficiency", "0.5", "does not go with interface = \"bridge\", only with sece"),
        ("circuit.rectifier.interface", "series-sshi", "`quality_factor` is missing"),
        ("circuit.rectifier.battery", "1 V", "circuit.rectifier.resistance has no effect: a battery takes the charge"),
        ("circuit.rectifier.diode_drop", "-1 V", "must be at least 0"),
    ] {
        let mut file = jounce::spec::SpecFile::read(rows::folder(EXAMPLE).join("harvester.toml")).unwrap();
        let found = file.set(key, value).map_or_else(|fault| fault.to_string(), |_| file.spec().unwrap_err().to_string());
        assert!(found.contains(told), "{key} = {value}: {found}");
    }
}

#[test]
fn a_rectifier_has_no_frequency_response() {
    let spec = jounce::spec::SpecFile::read(rows::folder(EXAMPLE).join("harvester.toml")).unwrap().spec().unwrap();
    let plant = Plant::new(System::assemble(&spec, jounce::structure::modes(&spec).unwrap()).unwrap()).unwrap();
    let refused = jounce::linear::frf(&plant, &Input::BaseAcceleration, &[], &[1.0]).unwrap_err();
    assert_eq!(refused, PlantError::Switches { circuit: "rectifier".to_owned() });
}
