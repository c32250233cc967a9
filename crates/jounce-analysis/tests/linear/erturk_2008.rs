//! `examples/unimorph-erturk-2008`: Erturk and Inman, J. Vib. Acoust. 130 (2008) 041002.

use crate::expected::{best_resistance, check, peak, plant, spec, voltage_per_g};
use jounce_linalg::c64;
use jounce_model::linear::{FrfInput, FrfOutput, couplings, frf};
use jounce_model::reference::Cantilever;
use jounce_model::structure::modes;
use jounce_model::structure::section::{CrossSection, patch_moment_n_m_per_v};
use std::f64::consts::TAU;

const EXAMPLE: &str = "unimorph-erturk-2008";

fn with_load(resistance: &str) -> jounce_model::plant::Plant {
    plant(EXAMPLE, &[("circuit.load.resistance", resistance)])
}

/// Strain-rate and air damping of the paper, `c_s I / (Y I) w / 2 + c_a / m / (2 w)`.
fn proportional_damping_ratio(angular_frequency: f64) -> f64 {
    0.5 * (1.2433e-5 * angular_frequency + 4.886 / angular_frequency)
}

#[test]
fn every_expected_row_is_met() {
    let spec = spec(EXAMPLE, &[]);
    let natural = modes(&spec).unwrap().frequency_rad_s;
    let section = CrossSection::covered(&spec.beam["beam"], spec.patch.values());
    let (short, open) = (with_load("100 ohm"), with_load("10 Mohm"));
    let near = |plant: &jounce_model::plant::Plant, hz: f64| peak(plant, 0.98 * hz, 1.03 * hz);
    let highest = |resistance| near(&with_load(resistance), 48.0).1;
    let (best_low, power_low) = best_resistance(with_load, 47.8);
    let (best_high, power_high) = best_resistance(with_load, 48.8);
    check(
        EXAMPLE,
        &[
            ("natural_1_hz", natural[0] / TAU),
            ("natural_2_hz", natural[1] / TAU),
            ("natural_3_hz", natural[2] / TAU),
            ("damping_1", spec.damping.ratios[0]),
            ("damping_2", spec.damping.ratios[1]),
            ("damping_3", spec.damping.ratios[2]),
            (
                "proportional_damping_1",
                proportional_damping_ratio(natural[0]),
            ),
            (
                "proportional_damping_2",
                proportional_damping_ratio(natural[1]),
            ),
            (
                "proportional_damping_3",
                proportional_damping_ratio(natural[2]),
            ),
            ("short_circuit_1_hz", near(&short, 47.8).0),
            ("short_circuit_2_hz", near(&short, 299.6).0),
            ("short_circuit_3_hz", near(&short, 838.2).0),
            ("open_circuit_1_hz", near(&open, 48.8).0),
            ("open_circuit_2_hz", near(&open, 301.5).0),
            ("open_circuit_3_hz", near(&open, 839.2).0),
            (
                "capacitance_nf",
                spec.patch["ceramic"].clamped_capacitance_f() * 1e9,
            ),
            ("bending_stiffness_n_m2", section.bending_stiffness_n_m2),
            ("mass_per_length_kg_m", section.mass_per_length_kg_m),
            ("voltage_1_kohm_v_per_g", highest("1 kohm")),
            ("voltage_10_kohm_v_per_g", highest("10 kohm")),
            ("voltage_100_kohm_v_per_g", highest("100 kohm")),
            ("voltage_1_mohm_v_per_g", highest("1 Mohm")),
            ("voltage_10_mohm_v_per_g", highest("10 Mohm")),
            ("best_resistance_at_47_8_hz_kohm", best_low / 1e3),
            ("best_resistance_at_48_8_hz_kohm", best_high / 1e3),
            ("peak_power_at_47_8_hz_mw_per_g2", power_low * 1e3),
            ("peak_power_at_48_8_hz_mw_per_g2", power_high * 1e3),
        ],
    );
}

/// Slope of a mode at the tip,
/// `phi'(L) = l / L (sinh l + sin l - s (cosh l - cos l)) / sqrt(m L)`, positive like `phi(L)`.
fn tip_slope(closed: &Cantilever, mode: usize) -> f64 {
    let l = Cantilever::root(mode);
    let s = (l.cosh() + l.cos()) / (l.sinh() + l.sin());
    let sign = if mode.is_multiple_of(2) { 1.0 } else { -1.0 };
    let root_mass = (closed.mass_per_length_kg_m * closed.length_m).sqrt();
    sign * l / closed.length_m * (l.sinh() + l.sin() - s * (l.cosh() - l.cos())) / root_mass
}

/// Eqs. (33) to (38) of the paper with the closed-form modes of a clamped-free beam, in every
/// retained mode: `V / a = sum (i w chi gamma / D) / (1/R + i w C + sum i w chi^2 / D)`. Measured
/// 2e-12.
#[test]
fn voltage_and_motion_are_the_closed_form() {
    let spec = spec(EXAMPLE, &[]);
    let (beam, patch) = (&spec.beam["beam"], &spec.patch["ceramic"]);
    let section = CrossSection::covered(beam, spec.patch.values());
    let closed = Cantilever {
        bending_stiffness_n_m2: section.bending_stiffness_n_m2,
        mass_per_length_kg_m: section.mass_per_length_kg_m,
        length_m: beam.length_m,
    };
    let moment = patch_moment_n_m_per_v(beam, &section, patch);
    let capacitance_f = patch.clamped_capacitance_f();
    let plant = plant(EXAMPLE, &[]);
    for frequency_hz in [10.0, 47.81, 48.3, 120.0, 300.0, 900.0] {
        let w = TAU * frequency_hz;
        let (mut source, mut mobility) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
        let dynamic = |mode: usize| {
            let natural = closed.frequency_rad_s(mode);
            c64::new(
                natural * natural - w * w,
                2.0 * spec.damping.ratios[mode] * natural * w,
            )
        };
        for mode in 0..spec.damping.ratios.len() {
            let chi = moment * tip_slope(&closed, mode);
            source += c64::new(0.0, w * chi * closed.participation_sqrt_kg(mode)) / dynamic(mode);
            mobility += c64::new(0.0, w * chi * chi) / dynamic(mode);
        }
        let voltage = source / (1.0 / 1e5 + c64::new(0.0, w * capacitance_f) + mobility);
        let tip: c64 = (0..spec.damping.ratios.len())
            .map(|mode| {
                let chi = moment * tip_slope(&closed, mode);
                (voltage * chi - closed.participation_sqrt_kg(mode))
                    * closed.shape(mode, closed.length_m)
                    / dynamic(mode)
            })
            .sum();
        let outputs = [
            FrfOutput::Voltage("ceramic".into()),
            FrfOutput::Displacement("beam.end".into()),
        ];
        let responses = frf(
            &plant,
            &FrfInput::BaseAcceleration,
            &outputs,
            &[frequency_hz],
        )
        .unwrap();
        for (response, exact) in responses.iter().zip([voltage, tip]) {
            let error = (response.value[0] - exact).norm() / exact.norm();
            assert!(
                error < 1e-9,
                "{frequency_hz} Hz, {}: {error:e}",
                response.response.name()
            );
        }
    }
    assert!(voltage_per_g(&plant, 48.0) > 0.0);
}

/// One patch and one mode: the load with the largest power at the short-circuit frequency, from the
/// responses over two resistances, is that of the coupling.
#[test]
fn the_coupling_has_the_load_with_the_largest_power() {
    let single = |resistance: &str| {
        let mode = ("reduction.modes", "1");
        plant(EXAMPLE, &[mode, ("circuit.load.resistance", resistance)])
    };
    let coupling = &couplings(&modes(&spec(EXAMPLE, &[])).unwrap())[0];
    let (best_ohm, _) = best_resistance(single, coupling.short_circuit_hz);
    let error = (coupling.optimal_resistance_ohm / best_ohm - 1.0).abs();
    assert!(error < 1e-9, "{error:e}");
    let reactance_ohm = 1.0 / (TAU * coupling.short_circuit_hz * coupling.capacitance_f);
    let error = (coupling.matched_resistance_ohm / reactance_ohm - 1.0).abs();
    assert!(error < 1e-14, "{error:e}");
}
