//! `examples/bimorph-erturk-2009`: Erturk and Inman, Smart Mater. Struct. 18 (2009) 025009.

use crate::expected::{best_resistance, check, peak, plant, spec, voltage_per_g};
use jounce::plant::Plant;
use jounce::structure::modes;
use jounce::structure::section::{CrossSection, patch_moment_n_m_per_v};
use std::f64::consts::TAU;

const EXAMPLE: &str = "bimorph-erturk-2009";

fn wired(wiring: &str, resistance: &str) -> Plant {
    plant(EXAMPLE, &[("circuit.load.wiring", wiring), ("circuit.load.resistance", resistance)])
}

#[test]
fn every_expected_row_is_met() {
    let spec = spec(EXAMPLE, &[]);
    let section = CrossSection::covered(&spec.beam["shim"], spec.patch.values());
    let moment = patch_moment_n_m_per_v(&spec.beam["shim"], &section, &spec.patch["top"]);
    let short_hz = modes(&spec).unwrap().frequency_rad_s[0] / TAU;
    let highest = |resistance| peak(&wired("series", resistance), 44.0, 50.0);
    let open_hz = highest("100 Mohm").0;
    let node = &wired("series", "1 kohm").electrical.nodes[0];
    let (best_short, power) = best_resistance(|resistance| wired("series", resistance), short_hz);
    let (best_open, _) = best_resistance(|resistance| wired("series", resistance), open_hz);
    check(
        EXAMPLE,
        &[
            ("short_circuit_hz", short_hz),
            ("open_circuit_hz", open_hz),
            ("measured_short_circuit_hz", short_hz),
            ("measured_open_circuit_hz", open_hz),
            ("bending_stiffness_n_m2", section.bending_stiffness_n_m2),
            ("series_capacitance_nf", node.capacitance_f * 1e9),
            // Each layer sees half the voltage and both push the same way.
            ("series_moment_n_m_per_v", moment),
            ("voltage_1_kohm_v_per_g", highest("1 kohm").1),
            ("voltage_33_kohm_v_per_g", highest("33 kohm").1),
            ("voltage_100_kohm_v_per_g", highest("100 kohm").1),
            ("voltage_470_kohm_v_per_g", highest("470 kohm").1),
            ("voltage_995_kohm_v_per_g", highest("995 kohm").1),
            ("best_resistance_at_short_circuit_kohm", best_short / 1e3),
            ("best_resistance_at_open_circuit_kohm", best_open / 1e3),
            ("peak_power_mw_per_g2", power * 1e3),
        ],
    );
}

/// `V_series(R) = 2 V_parallel(R / 4)` at every frequency; measured 2e-13. Connected the wrong way round the layers cancel.
#[test]
fn series_and_parallel_are_one_harvester() {
    for (series, parallel) in [("1 kohm", "250 ohm"), ("100 kohm", "25 kohm"), ("4 Mohm", "1 Mohm")] {
        let (one, other) = (wired("series", series), wired("parallel", parallel));
        for frequency_hz in [20.0, 45.7, 47.0, 48.1, 400.0] {
            let ratio = voltage_per_g(&one, frequency_hz) / voltage_per_g(&other, frequency_hz);
            assert!((ratio / 2.0 - 1.0).abs() < 1e-10, "{series} {frequency_hz}: {ratio}");
        }
    }
    // Two equal layers in series need no state but their terminal voltage.
    assert_eq!(wired("series", "1 kohm").electrical.nodes.len(), 1);
    for wiring in ["series", "parallel"] {
        let wrong = plant(EXAMPLE, &[("circuit.load.patches", "[\"top\", \"bottom\"]"), ("circuit.load.wiring", wiring)]);
        assert!(voltage_per_g(&wrong, 47.0) < 1e-9 * voltage_per_g(&wired(wiring, "100 kohm"), 47.0));
    }
}
