//! Mode shapes, time histories, spectra and frequency responses.

use crate::{checked_svg, grid};
use jounce_plot::*;
use std::f64::consts::TAU;

#[test]
fn mode_shapes_along_the_beam() {
    let position_m = grid(0.0, 0.315, 200);
    let shape = |beta: f64, ratio: f64, x: f64| {
        let s = beta * x / 0.315;
        s.cosh() - s.cos() - ratio * (s.sinh() - s.sin())
    };
    let roots = [
        (1.875_104, 0.734_096, 8.66),
        (4.694_091, 1.018_467, 50.3),
        (7.854_757, 0.999_224, 140.9),
        (10.995_541, 1.000_034, 278.9),
    ];
    let shapes: Vec<_> = roots
        .iter()
        .enumerate()
        .map(|(i, (beta, ratio, hz))| ModeShape {
            label: format!("{}: {hz} Hz", i + 1),
            displacement: position_m
                .iter()
                .map(|x| shape(*beta, *ratio, *x))
                .collect(),
        })
        .collect();
    let patches = [ShapePatch {
        label: "patch mfc".into(),
        start_m: 0.009,
        end_m: 0.094,
    }];
    let figure = mode_shapes(
        "Mode shapes of the clamped beam",
        &position_m,
        &shapes,
        &patches,
    );
    checked_svg(
        "mode-shapes",
        &figure,
        &[
            "Position along the beam (mm)",
            "1: 8.66 Hz",
            "patch mfc",
            "300",
        ],
    );
}

#[test]
fn one_and_several_time_histories() {
    let time_s = grid(19.0, 20.0, 4001);
    let voltage = |t: &f64| {
        13.0 * (TAU * 13.0 * t).sin()
            + 2.1 * (TAU * 52.0 * t + 1.0).sin()
            + 1.2 * (TAU * 26.0 * t).sin()
    };
    let voltage = Trace {
        quantity: "Voltage".into(),
        unit: "V".into(),
        values: time_s.iter().map(voltage).collect(),
    };
    let force = Trace {
        quantity: "Contact force".into(),
        unit: "N".into(),
        values: time_s
            .iter()
            .map(|t| (40.0 * ((TAU * 13.0 * t).sin() - 0.8)).max(0.0))
            .collect(),
    };
    let tip = Trace {
        quantity: "Tip displacement".into(),
        unit: "m".into(),
        values: time_s
            .iter()
            .map(|t| 0.015 * (TAU * 13.0 * t).sin())
            .collect(),
    };
    let one = time_histories(
        "Voltage with impact, 13 Hz and 200 N",
        &time_s,
        std::slice::from_ref(&voltage),
    );
    checked_svg(
        "time-history",
        &one,
        &["Time (s)", "Voltage (V)", "19.2", "−10"],
    );
    let three = time_histories(
        "Last second with impact, 13 Hz and 200 N",
        &time_s,
        &[voltage, force, tip],
    );
    let svg = checked_svg(
        "time-histories",
        &three,
        &["Time (s)", "Contact force (N)", "Tip displacement (mm)"],
    );
    assert_eq!(
        svg.matches(">Time (s)<").count(),
        1,
        "stacked panels share their time axis"
    );
}

#[test]
fn spectra_with_the_orders_of_the_drive() {
    let frequency_hz = grid(0.0, 100.0, 4001);
    let line = |f: f64, at: f64, a: f64| a / (1.0 + ((f - at) / 0.05).powi(4));
    let lines = [
        (13.5, 13.0),
        (27.0, 1.2),
        (40.5, 0.9),
        (54.0, 2.1),
        (67.5, 0.3),
        (81.0, 0.1),
    ];
    let amplitude = |half: f64| {
        let value = |f: &f64| {
            1e-3 + lines
                .iter()
                .map(|(at, a)| line(*f, *at, *a) + line(*f, at - 6.75, half * a))
                .sum::<f64>()
        };
        frequency_hz.iter().map(value).collect()
    };
    let line = |label: &str, half: f64| SpectrumLine {
        label: label.into(),
        frequency_hz: frequency_hz.clone(),
        amplitude_peak: amplitude(half),
    };
    let log = spectra(
        "Amplitude spectrum of the voltage at 13.5 Hz",
        "Voltage",
        "V",
        Scale::Log,
        &[line("", 0.0)],
        Some(13.5),
    );
    checked_svg(
        "spectrum-log",
        &log,
        &["drive", "4×", "Voltage, peak (V)", "Frequency (Hz)"],
    );
    let both = [line("period 1", 0.0), line("period 2", 0.2)];
    let linear = spectra(
        "Two orbits at 13.5 Hz and 100 kΩ",
        "Voltage",
        "V",
        Scale::Linear,
        &both,
        Some(13.5),
    );
    checked_svg("spectra-linear", &linear, &["period 1", "period 2", "7×"]);
}

#[test]
fn frequency_response_with_phase() {
    let frequency_hz: Vec<_> = grid(0.0, 3.0, 3000)
        .into_iter()
        .map(|e| 10f64.powf(e))
        .collect();
    let modes = [
        (8.66, 0.002, 1.0),
        (50.3, 0.009, -0.8),
        (140.9, 0.0086, 0.7),
        (278.9, 0.0036, -0.6),
        (457.6, 0.0013, 0.5),
    ];
    let value = |f: f64| {
        let (mut re, mut im) = (0.0, 0.0);
        for (at, zeta, a) in modes {
            let (p, q) = (at * at - f * f, 2.0 * zeta * at * f);
            let size = -f * f * a / (p * p + q * q);
            (re, im) = (re + size * p, im - size * q);
        }
        (re, im)
    };
    let response = |label: &str, factor: f64| {
        let (re, im) = frequency_hz.iter().map(|f| value(*f * factor)).unzip();
        ResponseLine {
            label: label.into(),
            re,
            im,
        }
    };
    let title = "Frequency response function for the acceleration at the free end";
    let one = frequency_responses(
        title,
        "Acceleration per force",
        "m/s^2/N",
        Scale::Linear,
        &frequency_hz,
        &[response("", 1.0)],
    );
    checked_svg(
        "frf",
        &one,
        &[
            "Phase (°)",
            "−180",
            "Acceleration per force (m/s²/N)",
            "Frequency (Hz)",
        ],
    );
    let both = [response("thin skin", 1.0), response("laminate", 1.04)];
    let two = frequency_responses(
        title,
        "Acceleration per force",
        "m/s^2/N",
        Scale::Log,
        &frequency_hz,
        &both,
    );
    checked_svg("frf-two", &two, &["thin skin", "laminate", "100", "1000"]);
}
