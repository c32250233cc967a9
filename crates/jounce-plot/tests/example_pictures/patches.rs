//! `mfc-bender-bilgen-2010`, `porous-patch-martinez-ayuso`: effect of another patch.

use crate::comparison::check;
use crate::example::plant;
use crate::loads::{logarithmic_range, over_resistance, per_g, power_per_g2};
use jounce_model::linear::FrfOutput;
use jounce_plot::{Axis, Colour, Figure, Panel, Series, power_against_resistance};

/// Frequency of the highest voltage of an open patch between two frequencies, Hz.
fn resonance_hz(
    example: &str,
    patch: &str,
    settings: &[(&str, &str)],
    low_hz: f64,
    high_hz: f64,
) -> f64 {
    let frequency_hz = logarithmic_range(low_hz, high_hz, 4001);
    let voltage = per_g(
        &plant(example, settings),
        FrfOutput::Voltage(patch.into()),
        &frequency_hz,
    );
    let highest = (0..voltage.len())
        .max_by(|a, b| voltage[*a].total_cmp(&voltage[*b]))
        .unwrap();
    frequency_hz[highest]
}

#[test]
fn the_two_kinds_of_macro_fibre_composite() {
    const EXAMPLE: &str = "mfc-bender-bilgen-2010";
    let kinds = ["MFC-P2", "MFC-P1"];
    let frequency_hz = logarithmic_range(10.0, 500.0, 1000);
    let mut voltage = Panel::new(
        Axis::log("Frequency", "Hz"),
        Axis::log("Voltage at 100 kΩ per g, peak", "V"),
    )
    .high(240.0);
    let mut tip = Panel::new(
        Axis::log("Frequency", "Hz"),
        Axis::log("Tip per g, peak", "m"),
    )
    .high(200.0);
    for (index, kind) in kinds.into_iter().enumerate() {
        let plant = plant(
            EXAMPLE,
            &[("patch.mfc.material", kind), ("reduction.modes", "6")],
        );
        let line = |response| {
            Series::line(frequency_hz.clone(), per_g(&plant, response, &frequency_hz))
                .colour(Colour::nth(index))
        };
        let label = if kind == "MFC-P2" {
            "MFC-P2, d31"
        } else {
            "MFC-P1, d33"
        };
        voltage = voltage.with(line(FrfOutput::LoadVoltage("load".into())).label(label));
        tip = tip.with(line(FrfOutput::Displacement("substrate.end".into())));
    }
    let title = "Two kinds of Macro Fiber Composite on one substrate whose base shakes";
    check(
        EXAMPLE,
        "responses",
        &Figure::new(title).with(voltage).with(tip),
    );
}

#[test]
fn a_porous_and_a_dense_patch() {
    const EXAMPLE: &str = "porous-patch-martinez-ayuso";
    let dense = [("patch.porous.porosity", "0")];
    let resistance_ohm = logarithmic_range(1e3, 1e7, 61);
    let lines: Vec<_> = [("30 % of pores", &[][..]), ("dense", &dense[..])]
        .into_iter()
        .map(|(label, settings)| {
            let settings = [settings, &[("stop.tip.gap", "1 m")]].concat();
            let frequency_hz = resonance_hz(EXAMPLE, "porous", &settings, 15.0, 40.0);
            over_resistance(
                &format!("{label}, {frequency_hz:.1} Hz"),
                &resistance_ohm,
                |ohm, words| {
                    let settings = [&settings[..], &[("circuit.load.resistance", words)]].concat();
                    power_per_g2(&plant(EXAMPLE, &settings), frequency_hz, ohm)
                },
            )
        })
        .collect();
    let title = "Mean power without contact, each at its open-circuit resonance, for a base that shakes with a peak of 1 g";
    check(
        EXAMPLE,
        "power",
        &power_against_resistance(title, "W", &lines),
    );
}
