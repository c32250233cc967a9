//! `examples/bimorph-erturk-2009`: Erturk and Inman, Smart Mater. Struct. 18 (2009) 025009.

use crate::expected::{best_resistance, check, peak, plant, spec, voltage_per_g};
use jounce_model::plant::Plant;
use jounce_model::structure::modes;
use jounce_model::structure::section::{CrossSection, patch_moment_n_m_per_v};
use std::f64::consts::TAU;

const EXAMPLE: &str = "bimorph-erturk-2009";

fn with_wiring(wiring: &str, resistance: &str) -> Plant {
    plant(
        EXAMPLE,
        &[
            ("circuit.load.wiring", wiring),
            ("circuit.load.resistance", resistance),
        ],
    )
}

#[test]
fn every_expected_row_is_met() {
    let spec = spec(EXAMPLE, &[]);
    let section = CrossSection::covered(&spec.beam["shim"], spec.patch.values());
    let moment = patch_moment_n_m_per_v(&spec.beam["shim"], &section, &spec.patch["top"]);
    let short_hz = modes(&spec).unwrap().frequency_rad_s[0] / TAU;
    let highest = |resistance| peak(&with_wiring("series", resistance), 44.0, 50.0);
    let peaks = ["1 kohm", "33 kohm", "100 kohm", "470 kohm", "995 kohm"].map(highest);
    let open_hz = highest("100 Mohm").0;
    let node = &with_wiring("series", "1 kohm").electrical.nodes[0];
    let best = |wiring, frequency_hz| {
        best_resistance(|resistance| with_wiring(wiring, resistance), frequency_hz)
    };
    let (best_short, power) = best("series", short_hz);
    let (best_open, _) = best("series", open_hz);
    check(
        EXAMPLE,
        &[
            ("short_circuit_hz", short_hz),
            ("open_circuit_hz", open_hz),
            ("measured_short_circuit_hz", short_hz),
            ("measured_open_circuit_hz", open_hz),
            ("bending_stiffness_n_m2", section.bending_stiffness_n_m2),
            ("series_capacitance_nf", node.capacitance_f * 1e9),
            // Each layer has half the voltage, and both act in the same direction.
            ("series_moment_n_m_per_v", moment),
            ("voltage_1_kohm_v_per_g", peaks[0].1),
            ("voltage_peak_1_kohm_hz", peaks[0].0),
            ("voltage_33_kohm_v_per_g", peaks[1].1),
            ("voltage_peak_33_kohm_hz", peaks[1].0),
            ("voltage_100_kohm_v_per_g", peaks[2].1),
            ("voltage_peak_100_kohm_hz", peaks[2].0),
            ("voltage_470_kohm_v_per_g", peaks[3].1),
            ("voltage_peak_470_kohm_hz", peaks[3].0),
            ("voltage_995_kohm_v_per_g", peaks[4].1),
            ("voltage_peak_995_kohm_hz", peaks[4].0),
            ("best_resistance_at_short_circuit_kohm", best_short / 1e3),
            ("best_resistance_at_open_circuit_kohm", best_open / 1e3),
            (
                "published_best_resistance_at_short_circuit_kohm",
                best_short / 1e3,
            ),
            (
                "published_best_resistance_at_open_circuit_kohm",
                best_open / 1e3,
            ),
            (
                "parallel_best_resistance_at_short_circuit_kohm",
                best("parallel", short_hz).0 / 1e3,
            ),
            (
                "parallel_best_resistance_at_open_circuit_kohm",
                best("parallel", open_hz).0 / 1e3,
            ),
            ("peak_power_mw_per_g2", power * 1e3),
            ("published_peak_power_mw_per_g2", power * 1e3),
        ],
    );
}

/// `V_series(R) = 2 V_parallel(R / 4)` at every frequency; measured 2e-13. With reversed polarity
/// the layers cancel.
#[test]
fn series_and_parallel_are_one_harvester() {
    for (series, parallel) in [
        ("1 kohm", "250 ohm"),
        ("100 kohm", "25 kohm"),
        ("4 Mohm", "1 Mohm"),
    ] {
        let (one, other) = (
            with_wiring("series", series),
            with_wiring("parallel", parallel),
        );
        for frequency_hz in [20.0, 45.7, 47.0, 48.1, 400.0] {
            let ratio = voltage_per_g(&one, frequency_hz) / voltage_per_g(&other, frequency_hz);
            assert!(
                (ratio / 2.0 - 1.0).abs() < 1e-10,
                "{series} {frequency_hz}: {ratio}"
            );
        }
    }
    // No motion drives the difference of two equal layers in series; its state is there, so that
    // unequal layers have the same states.
    let unequal = [("patch.top.thickness", "0.27 mm")];
    for (plant, is_driven) in [
        (plant(EXAMPLE, &[]), false),
        (plant(EXAMPLE, &unequal), true),
    ] {
        let [_, difference] = plant.electrical.nodes.as_slice() else {
            panic!("{:?}", plant.electrical.nodes);
        };
        let coupling = &difference.coupling_n_per_v;
        assert_eq!(coupling.iter().any(|theta| *theta != 0.0), is_driven);
    }
    for wiring in ["series", "parallel"] {
        let reversed_plant = plant(
            EXAMPLE,
            &[
                ("circuit.load.patches", "[\"top\", \"bottom\"]"),
                ("circuit.load.wiring", wiring),
            ],
        );
        assert!(
            voltage_per_g(&reversed_plant, 47.0)
                < 1e-9 * voltage_per_g(&with_wiring(wiring, "100 kohm"), 47.0)
        );
    }
}

/// One mode and its circuit, `Y = i w C (1 + k^2 w_s^2 / (w_s^2 - w^2 + 2 i zeta w_s w))` with
/// `k^2 = theta^2 / (C w_s^2)`. The best resistance is `1 / |Y|`, at the short-circuit and
/// open-circuit resonances in closed form. No mean power exceeds `sigma^2 a^2 / (16 zeta w_s)`.
/// Measured: 8e-15 of the resistances.
#[test]
fn one_mode_has_the_best_resistances_of_the_closed_form() {
    let single = |resistance: &str| {
        plant(
            EXAMPLE,
            &[
                ("reduction.modes", "1"),
                ("circuit.load.resistance", resistance),
            ],
        )
    };
    let single_harvester = single("1 kohm");
    let (modes, node) = (
        &single_harvester.system.modes,
        &single_harvester.electrical.nodes[0],
    );
    let (short, zeta) = (modes.frequency_rad_s[0], modes.damping_ratio[0]);
    // In series each layer has half of the voltage.
    let theta = 0.5
        * (modes.patch["top"].coupling_n_per_v[0].abs()
            + modes.patch["bottom"].coupling_n_per_v[0].abs());
    let squared_coupling = theta * theta / (node.capacitance_f * short * short);
    let open = short * (1.0 + squared_coupling).sqrt();
    let at_short =
        1.0 / (node.capacitance_f * short * (1.0 + (0.5 * squared_coupling / zeta).powi(2)).sqrt());
    let at_open = (1.0 + squared_coupling.powi(2) / (4.0 * zeta * zeta * (1.0 + squared_coupling)))
        .sqrt()
        / (open * node.capacitance_f);
    let bound_w = (modes.participation_sqrt_kg[0] * 9.81).powi(2) / (16.0 * zeta * short);
    for (angular_frequency, exact) in [(short, at_short), (open, at_open)] {
        let (best_ohm, squared_over_resistance) = best_resistance(single, angular_frequency / TAU);
        let share = 0.5 * squared_over_resistance / bound_w;
        eprintln!(
            "{best_ohm} against {exact} ohm: {:.1e}, {share:.4} of the bound",
            best_ohm / exact - 1.0
        );
        assert!(
            (best_ohm / exact - 1.0).abs() < 1e-12 && (0.9..1.0).contains(&share),
            "{best_ohm} {exact} {share}"
        );
    }
}
