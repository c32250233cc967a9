//! `examples/plate-de-marqui-2009`: De Marqui, Erturk and Inman, J. Sound Vib. 327 (2009) 9, with the
//! dimensions of Erturk and Inman, J. Vib. Acoust. 130 (2008) 041002.

use crate::expected::{peak, plant, spec};
use crate::rows::check_row;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::Plant;
use jounce_model::structure::modes;
use std::f64::consts::TAU;

const EXAMPLE: &str = "plate-de-marqui-2009";
const BEAM: &str = "unimorph-erturk-2008";

fn with_load(resistance: &str) -> Plant {
    plant(EXAMPLE, &[("circuit.load.resistance", resistance)])
}

/// Modes that bend along the length only respond to the base; the others twist.
#[test]
fn every_expected_row_is_met() {
    let spec = spec(EXAMPLE, &[]);
    let modes = modes(&spec).unwrap();
    let natural: Vec<f64> = (0..modes.len())
        .filter(|mode| modes.participation_sqrt_kg[*mode].abs() > 1e-6)
        .map(|mode| modes.frequency_rad_s[mode] / TAU)
        .collect();
    let (short, open) = (with_load("100 ohm"), with_load("10 Mohm"));
    let near = |plant: &Plant, hz: f64| peak(plant, 0.98 * hz, 1.03 * hz);
    let highest = |resistance| near(&with_load(resistance), 48.0).1;
    let rows = [
        ("natural_1_hz", natural[0]),
        ("natural_2_hz", natural[1]),
        ("natural_3_hz", natural[2]),
        ("short_circuit_1_hz", near(&short, 47.8).0),
        ("short_circuit_2_hz", near(&short, 299.6).0),
        ("open_circuit_1_hz", near(&open, 48.8).0),
        ("open_circuit_2_hz", near(&open, 301.5).0),
        ("capacitance_nf", modes.patch["ceramic"].capacitance_f * 1e9),
        ("voltage_1_kohm_v_per_g", highest("1 kohm")),
        ("voltage_10_kohm_v_per_g", highest("10 kohm")),
        ("voltage_100_kohm_v_per_g", highest("100 kohm")),
        ("voltage_1_mohm_v_per_g", highest("1 Mohm")),
        ("voltage_10_mohm_v_per_g", highest("10 Mohm")),
    ];
    for (name, value) in rows {
        check_row(EXAMPLE, name, value);
    }
}

/// The voltage and the motion of the tip over frequency, against the same unimorph as a beam.
/// Measured: 1e-5 relative to the magnitude at each frequency.
#[test]
fn the_narrow_plate_responds_as_the_beam() {
    let hertz: Vec<f64> = (0..60)
        .map(|k| 10.0 * 100f64.powf(f64::from(k) / 59.0))
        .collect();
    let response = |plant: &Plant, point: &str| {
        let wanted = [
            FrfOutput::LoadVoltage("load".into()),
            FrfOutput::Displacement(point.into()),
        ];
        frf(plant, &FrfInput::BaseAcceleration, &wanted, &hertz).unwrap()
    };
    let wide = response(&plant(EXAMPLE, &[]), "plate.tip");
    let narrow = response(&plant(BEAM, &[]), "beam.end");
    for (wide, narrow) in wide.iter().zip(&narrow) {
        for ((found, expected), hz) in wide.value.iter().zip(&narrow.value).zip(&hertz) {
            let error = (found - expected).norm() / expected.norm();
            assert!(error < 1e-3, "{hz} Hz: {found} {expected} {error:e}");
        }
    }
}

/// With the contraction of its materials the plate is stiffer than the beam, but by less than
/// `1 / sqrt(1 - nu^2)`, because a narrow plate is free to curl.
#[test]
fn contraction_stiffens_a_plate_less_than_a_held_width() {
    let first =
        |settings: &[(&str, &str)]| modes(&spec(EXAMPLE, settings)).unwrap().frequency_rad_s[0];
    let keys = ["plate.plate.poisson_ratio", "patch.ceramic.poisson_ratio"];
    let plain = first(&[]);
    let mut before = plain;
    for width in ["20 mm", "60 mm", "200 mm"] {
        let wide = [("plate.plate.width", width), ("patch.ceramic.width", width)];
        let contracted = first(&[wide[0], wide[1], (keys[0], "0.3"), (keys[1], "0.3")]);
        let limit = plain / (1.0_f64 - 0.09).sqrt();
        assert!(
            contracted > before && contracted < limit,
            "{width}: {contracted} {before} {limit}"
        );
        before = contracted;
    }
}
