//! `unimorph-erturk-2008`, `bimorph-erturk-2009`, `plate-de-marqui-2009`: responses to a shaken base at several loads.

use crate::comparison::check;
use crate::example::plant;
use crate::loads::{logarithmic_range, over_resistance, per_g, power_per_g2};
use jounce_model::linear::FrfOutput;
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
    let lines = |response: FrfOutput, per_load: &dyn Fn(f64) -> f64| -> Vec<(&str, Vec<f64>)> {
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
    let voltage = || FrfOutput::LoadVoltage("load".into());
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
        &lines(FrfOutput::Displacement("beam.end".into()), &|_| 1.0),
        false,
    ));
    check(EXAMPLE, "responses", &figure);
}

/// The wider the plate, the stiffer it is: its width cannot curl freely.
#[test]
fn plate_voltage_at_four_widths() {
    const EXAMPLE: &str = "plate-de-marqui-2009";
    let frequency_hz: Vec<f64> = (0..401).map(|k| 44.0 + 0.02 * f64::from(k)).collect();
    let line = |label: &'static str, width: &str, ratio: &str| {
        let settings = [
            ("plate.plate.width", width),
            ("patch.ceramic.width", width),
            ("plate.plate.poisson_ratio", ratio),
            ("patch.ceramic.poisson_ratio", ratio),
            ("plate.plate.point.tip.y", "10 mm"),
        ];
        let plant = plant(EXAMPLE, &settings);
        let voltage = FrfOutput::LoadVoltage("load".into());
        (label, per_g(&plant, voltage, &frequency_hz))
    };
    let lines = [
        line("20 mm, no contraction (beam)", "20 mm", "0"),
        line("20 mm, Poisson's ratio 0.3", "20 mm", "0.3"),
        line("50 mm, Poisson's ratio 0.3", "50 mm", "0.3"),
        line("100 mm, Poisson's ratio 0.3", "100 mm", "0.3"),
    ];
    let mut panel = Panel::new(
        Axis::linear("Frequency", "Hz"),
        Axis::linear("Voltage per g", "V"),
    );
    for (index, (label, value)) in lines.into_iter().enumerate() {
        let colour = jounce_plot::Colour::nth(index);
        let series = Series::line(frequency_hz.clone(), value);
        panel = panel.with(series.colour(colour).label(label));
    }
    let title = "Voltage at 100 kΩ of plates of four widths, peak value per g of the base";
    check(EXAMPLE, "widths", &Figure::new(title).with(panel));
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
