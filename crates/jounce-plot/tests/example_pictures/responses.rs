//! `unimorph-erturk-2008`, `bimorph-erturk-2009`: responses to a shaken base at several loads.

use crate::comparison::check;
use crate::example::plant;
use crate::loads::{logarithmic_range, over_resistance, per_g, power_per_g2};
use jounce_model::linear::FrfResponse;
use jounce_plot::{Axis, Figure, Panel, Series, power_against_resistance};

/// A panel with one curve per load.
fn panel(
    quantity: &str,
    unit: &str,
    frequency_hz: &[f64],
    lines: &[(&str, Vec<f64>)],
    named: bool,
) -> Panel {
    let mut panel = Panel::new(Axis::log("Frequency", "Hz"), Axis::log(quantity, unit)).high(210.0);
    for (index, (label, value)) in lines.iter().enumerate() {
        let series = Series::line(frequency_hz.to_vec(), value.clone())
            .colour(jounce_plot::Colour::nth(index));
        panel = panel.with(if named { series.label(label) } else { series });
    }
    panel
}

#[test]
fn unimorph_voltage_current_and_tip_at_five_loads() {
    const EXAMPLE: &str = "unimorph-erturk-2008";
    let frequency_hz = logarithmic_range(10.0, 1000.0, 1200);
    let loads = [
        ("1 kΩ", "1 kohm", 1e3),
        ("10 kΩ", "10 kohm", 1e4),
        ("100 kΩ", "100 kohm", 1e5),
        ("1 MΩ", "1 Mohm", 1e6),
        ("10 MΩ", "10 Mohm", 1e7),
    ];
    let lines = |response: FrfResponse, per_load: &dyn Fn(f64) -> f64| -> Vec<(&str, Vec<f64>)> {
        let line = |(label, words, ohm): &(&'static str, &str, f64)| {
            let plant = plant(EXAMPLE, &[("circuit.load.resistance", words)]);
            (
                *label,
                per_g(&plant, response.clone(), &frequency_hz)
                    .into_iter()
                    .map(|value| value * per_load(*ohm))
                    .collect(),
            )
        };
        loads.iter().map(line).collect()
    };
    let voltage = || FrfResponse::LoadVoltage("load".into());
    let figure = Figure::new(
        "Voltage, current and motion of the tip against the load, peak values per g of the base",
    )
    .with(panel(
        "Voltage per g",
        "V",
        &frequency_hz,
        &lines(voltage(), &|_| 1.0),
        true,
    ))
    .with(panel(
        "Current per g",
        "A",
        &frequency_hz,
        &lines(voltage(), &|ohm| 1.0 / ohm),
        false,
    ))
    .with(panel(
        "Tip per g, relative to the base",
        "m",
        &frequency_hz,
        &lines(FrfResponse::Displacement("beam.end".into()), &|_| 1.0),
        false,
    ));
    check(EXAMPLE, "responses", &figure);
}

#[test]
fn bimorph_power_in_series_and_parallel() {
    const EXAMPLE: &str = "bimorph-erturk-2009";
    let resistance_ohm = logarithmic_range(1e3, 1e7, 81);
    // Resonances with short-circuited and open electrodes.
    let lines: Vec<_> = [
        ("series", 45.7),
        ("series", 48.2),
        ("parallel", 45.7),
        ("parallel", 48.2),
    ]
    .into_iter()
    .map(|(wiring, frequency_hz)| {
        over_resistance(
            &format!("{wiring}, {frequency_hz} Hz"),
            &resistance_ohm,
            |ohm, words| {
                let settings = [
                    ("circuit.load.wiring", wiring),
                    ("circuit.load.resistance", words),
                ];
                power_per_g2(&plant(EXAMPLE, &settings), frequency_hz, ohm)
            },
        )
    })
    .collect();
    check(
        EXAMPLE,
        "power",
        &power_against_resistance(
            "Mean power for a base that shakes with a peak of 1 g",
            "W",
            &lines,
        ),
    );
}
