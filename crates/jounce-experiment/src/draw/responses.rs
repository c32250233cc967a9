//! Figures of frequency responses with coherence, stabilisation diagrams, and the modal fit to the
//! responses.

use jounce_plot::{
    Along, Axis, Colour, Figure, Line, Marker, Panel, ResponseLine, Scale, Series,
    frequency_responses,
};

use jounce_identification::modal::{Identification, Stability};
use jounce_identification::response::MeasuredResponses;

/// Plots magnitude, phase and, for several blocks, coherence of every response.
pub fn measured_responses(title: &str, result: &MeasuredResponses) -> Figure {
    let Some(first) = result.functions.first() else {
        return Figure::new(title);
    };
    // The line at 0 Hz contains the sensor's offset.
    let frequency_hz = first.frequency_hz[1..].to_vec();
    let one = |(name, function): (&String, &jounce_signal::spectral::FrequencyResponse)| {
        let (re, im) = function.value[1..].iter().map(|h| (h.re, h.im)).unzip();
        ResponseLine {
            label: name.clone(),
            re,
            im,
        }
    };
    let responses: Vec<ResponseLine> = result
        .names
        .iter()
        .zip(&result.functions)
        .map(one)
        .collect();
    let quantity = if responses.len() > 1 {
        "Response per input"
    } else {
        &result.names[0]
    };
    let mut figure = frequency_responses(
        title,
        quantity,
        &result.units[0],
        Scale::Linear,
        &frequency_hz,
        &responses,
    );
    if first.blocks > 1 {
        let axes = Panel::new(
            Axis::linear("Frequency", "Hz"),
            Axis::linear("Coherence", "").between(0.0, 1.05),
        )
        .high(120.0);
        let add =
            |panel: Panel, (k, function): (usize, &jounce_signal::spectral::FrequencyResponse)| {
                let line = Series::line(frequency_hz.clone(), function.coherence[1..].to_vec());
                panel.with(line.colour(Colour::nth(k)).style(Line::Thin))
            };
        figure = figure.with(result.functions.iter().enumerate().fold(axes, add));
    }
    figure
}

/// Plots poles by order: filled for stable frequency and damping, rings for stable frequency, small
/// squares for unstable poles; vertical lines for selected modes.
pub fn stabilisation(title: &str, result: &Identification) -> Figure {
    let (low, high) = (
        result.frequency_hz.first().copied().unwrap_or(0.0),
        result.frequency_hz.last().copied().unwrap_or(1.0),
    );
    let mut panel = Panel::new(
        Axis::linear("Frequency", "Hz").between(low, high),
        Axis::linear("Order", ""),
    )
    .high(360.0);
    for mode in &result.modes {
        panel = panel.reference(Along::X, mode.frequency_hz, None);
    }
    let kinds = [
        (
            Stability::Pole,
            Marker::Circle,
            Colour::nth(0),
            "frequency and damping stable",
        ),
        (
            Stability::Frequency,
            Marker::Ring,
            Colour::nth(1),
            "frequency stable",
        ),
        (Stability::New, Marker::Square, Colour::Grey, "new"),
    ];
    for (stable, marker, colour, label) in kinds {
        let in_band = |hz: f64| (low..=high).contains(&hz);
        let of_kind = result
            .diagram
            .iter()
            .filter(|pole| pole.stable == stable && in_band(pole.pole.frequency_hz));
        let (x, y): (Vec<f64>, Vec<f64>) = of_kind
            .map(|pole| (pole.pole.frequency_hz, pole.order as f64))
            .unzip();
        panel = panel.with(Series::points(x, y, marker).colour(colour).label(label));
    }
    Figure::new(title).with(panel)
}

/// Plots the responses of the band as displacement per force, with the fitted modal model.
pub fn modal_fit(title: &str, functions: &[(&String, String)], result: &Identification) -> Figure {
    let panel = |(k, (name, unit)): (usize, &(&String, String))| {
        let magnitudes = |response: &[jounce_linalg::c64]| {
            response.iter().map(|h| h.norm()).collect::<Vec<f64>>()
        };
        let axes = Panel::new(Axis::linear("Frequency", "Hz"), Axis::log(name, unit)).high(220.0);
        let measured = Series::line(result.frequency_hz.clone(), magnitudes(&result.measured[k]))
            .style(Line::Thin)
            .label("measured");
        let model = Series::line(result.frequency_hz.clone(), magnitudes(&result.model[k]))
            .colour(Colour::nth(1))
            .label("modes");
        axes.with(measured).with(model)
    };
    Figure {
        panels: functions.iter().enumerate().map(panel).collect(),
        ..Figure::new(title)
    }
}
