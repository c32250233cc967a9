//! Draws every kind of picture. The PNGs remain in the build folder under `tmp/pictures` for
//! inspection.
#![allow(clippy::unwrap_used, reason = "tests")]

mod moving_bases;

use std::f64::consts::{PI, TAU};
use std::path::Path;

use jounce_plot::*;

/// Width and height from the header of a PNG file.
fn size(png: &[u8]) -> (u32, u32) {
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

/// Writes both formats, checks the requirements of every picture and returns the SVG.
fn checked_svg(name: &str, figure: &Figure, texts: &[&str]) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures");
    std::fs::create_dir_all(&folder).unwrap();
    let (svg_path, png_path) = (
        folder.join(format!("{name}.svg")),
        folder.join(format!("{name}.png")),
    );
    figure.write(&svg_path).unwrap();
    figure.write(&png_path).unwrap();
    let (svg, png) = (
        std::fs::read_to_string(&svg_path).unwrap(),
        std::fs::read(&png_path).unwrap(),
    );
    let (width, height) = size(&png);
    assert_eq!(width, 2 * figure.width_px as u32, "{name}");
    assert!(
        svg.contains(&format!(
            "height=\"{}\"",
            trimmed_number(f64::from(height) / 2.0)
        )) || height % 2 == 1,
        "{name} {height}"
    );
    for text in texts {
        assert!(
            svg.contains(&format!(">{text}</text>")),
            "{name} lacks the text \"{text}\""
        );
    }
    assert!(
        !svg.contains("NaN") && !svg.contains("inf\"") && !svg.contains(" id="),
        "{name}"
    );
    assert_eq!(
        svg,
        figure.to_svg().unwrap(),
        "{name} is not the same twice"
    );
    svg
}

fn trimmed_number(value: f64) -> String {
    format!("{value:.2}")
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}

fn grid(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| from + (to - from) * i as f64 / (count - 1) as f64)
        .collect()
}

/// Squared size of a resonance at 8.7 Hz.
fn resonance(f: f64, zeta: f64) -> f64 {
    let r = f / 8.7;
    r * r / ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2))
}

fn power(f: f64) -> f64 {
    4e-9 * resonance(f, 0.005)
}

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

/// Curves like those of the paper's figure 6: hardening branches that jump.
fn sweep_lines() -> Vec<SweepLine> {
    let frequency_hz = grid(4.0, 20.0, 161);
    let linear = frequency_hz.iter().map(|f| power(*f)).collect();
    let mut lines = vec![SweepLine {
        label: "linear".into(),
        direction: LineDirection::Linear,
        parameter: frequency_hz.clone(),
        value: linear,
        settled: vec![],
    }];
    for (label, up_hz, down_hz) in [
        ("50 N", 11.8, 10.9),
        ("100 N", 13.9, 12.1),
        ("200 N", 17.2, 13.8),
    ] {
        let branch = |jump: f64| {
            move |f: &f64| {
                if *f < jump {
                    3e-9 * (f / 6.0).powi(4) / (1.0 + (6.0 / f).powi(8))
                } else {
                    power(*f) * 0.9
                }
            }
        };
        let up = frequency_hz.iter().map(branch(up_hz)).collect();
        let down: Vec<f64> = frequency_hz.iter().map(branch(down_hz)).collect();
        let settled = frequency_hz
            .iter()
            .map(|f| label != "200 N" || (*f - 6.0).abs() > 0.35)
            .collect();
        lines.push(SweepLine {
            label: label.into(),
            direction: LineDirection::Up,
            parameter: frequency_hz.clone(),
            value: up,
            settled,
        });
        let (back, down) = (
            frequency_hz.iter().rev().copied().collect(),
            down.into_iter().rev().collect(),
        );
        lines.push(SweepLine {
            label: label.into(),
            direction: LineDirection::Down,
            parameter: back,
            value: down,
            settled: vec![],
        });
    }
    lines
}

#[test]
fn sweep_up_and_down_at_three_levels() {
    let texts = [
        "linear",
        "50 N",
        "100 N",
        "200 N",
        "stepped up",
        "stepped down",
        "not settled",
        "Drive frequency (Hz)",
    ];
    let title = "Average power generated by impact, load resistance 1 MΩ";
    for (name, scale) in [("sweep-log", Scale::Log), ("sweep-linear", Scale::Linear)] {
        let svg = checked_svg(
            name,
            &sweep(
                title,
                &SweepLook::power_over_frequency(scale),
                &sweep_lines(),
            ),
            &texts,
        );
        assert_eq!(
            svg.matches("stroke-dasharray=\"6 4\"").count(),
            4,
            "three lines stepped down and their key are dashed"
        );
    }
}

#[test]
fn power_against_resistance_with_and_without_impact() {
    let resistance_ohm: Vec<_> = grid(4.0, 7.0, 31)
        .into_iter()
        .map(|e| 10f64.powf(e))
        .collect();
    let line = |label: &str, direction, best: f64, peak: f64| SweepLine {
        label: label.into(),
        direction,
        parameter: resistance_ohm.clone(),
        value: resistance_ohm
            .iter()
            .map(|r| peak * 2.0 * r * best / (r * r + best * best))
            .collect(),
        settled: vec![],
    };
    let lines = [
        line("without impact", LineDirection::Linear, 69.2e3, 4.1e-9),
        line("with impact", LineDirection::Independent, 67e3, 1.58e-8),
    ];
    let figure = power_against_resistance(
        "Effect of the load resistance, 13 Hz and 200 N",
        "W/N^2",
        &lines,
    );
    checked_svg(
        "resistance",
        &figure,
        &[
            "with impact, best at 66.9 kΩ",
            "without impact, best at 69.2 kΩ",
            "Load resistance (kΩ)",
            "Mean power per force squared (nW/N²)",
        ],
    );
}

#[test]
fn gaps_notes_and_awkward_labels() {
    let x = grid(0.0, 10.0, 101);
    let y = x
        .iter()
        .map(|x| {
            if (3.0..4.0).contains(x) {
                f64::NAN
            } else {
                (x * PI / 2.0).sin() * 1e-3
            }
        })
        .collect();
    let panel = Panel::new(
        Axis::linear("A quantity with <&> in its name", "s"),
        Axis::linear("A long title of a vertical axis that needs two lines", "V"),
    )
    .with(
        Series::line(x, y)
            .label("line with a gap")
            .marker(Marker::Square),
    )
    .band(Along::Y, -2e-4, 2e-4, Some("dead band"))
    .reference(Along::Y, 5e-4, Some("limit"))
    .reference(Along::X, 7.0, Some("start"))
    .reference(Along::X, 7.1, Some("too near"))
    .note(1.0, 1e-3, "first peak")
    .high(220.0);
    let title = "A title so long that it cannot stand on one line of the picture and has to be broken between two of its words somewhere";
    let svg = checked_svg(
        "awkward",
        &Figure::new(title).with(panel),
        &["limit", "start", "first peak", "dead band"],
    );
    assert!(
        !svg.contains("too near"),
        "a name that would touch another is left out"
    );
}

#[test]
fn empty_and_unusable_data_are_reported() {
    let empty = |x: Vec<f64>, y: Vec<f64>, axis: Axis| {
        Panel::new(axis.clone(), axis)
            .high(120.0)
            .with(Series::line(x, y))
    };
    let figure = Figure::new("Nothing to see")
        .with(empty(vec![], vec![], Axis::linear("a", "V")))
        .with(empty(
            vec![1.0, f64::NAN],
            vec![f64::NAN, 1.0],
            Axis::log("b", "V"),
        ))
        .with(empty(vec![0.0, -1.0], vec![1.0, 1.0], Axis::log("c", "V")));
    assert_eq!(
        checked_svg("empty", &figure, &[])
            .matches(">no data<")
            .count(),
        3
    );
    checked_svg("no-panels", &Figure::new("No panels at all"), &[]);
    for figure in [
        mode_shapes("", &[], &[], &[]),
        time_histories("", &[], &[]),
        spectra("", "", "", Scale::Log, &[], Some(f64::NAN)),
        frequency_responses("", "", "", Scale::Log, &[], &[]),
        sweep("", &SweepLook::power_over_frequency(Scale::Log), &[]),
        power_against_resistance("", "W", &[]),
    ] {
        assert!(!figure.to_png(1.0).unwrap().is_empty());
    }
}

#[test]
fn misuse_is_an_error() {
    let panel = || Panel::new(Axis::linear("a", "V"), Axis::linear("b", "V"));
    let faulty = |panel: Panel| Figure::new("").with(panel).to_svg().unwrap_err();
    assert!(matches!(
        faulty(panel().with(Series::line(vec![1.0], vec![]))),
        PictureError::Lengths { x: 1, y: 0, .. }
    ));
    assert!(matches!(
        faulty(Panel {
            x: Axis::linear("a", "V").between(2.0, 1.0),
            ..panel()
        }),
        PictureError::Range { .. }
    ));
    assert!(matches!(
        faulty(panel().high(f64::NAN)),
        PictureError::Size { .. }
    ));
    let figure = Figure::new("").with(panel());
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
        assert!(
            matches!(figure.to_png(scale), Err(PictureError::Size { .. })),
            "{scale}"
        );
    }
    assert!(matches!(
        figure.write(Path::new("figure.gif")),
        Err(PictureError::Format { .. })
    ));
    assert!(matches!(
        figure.write(Path::new("/no/such/folder/figure.svg")),
        Err(PictureError::Store(_))
    ));
}

/// The structure of a small picture, element by element.
#[test]
fn a_small_picture_has_this_structure() {
    let panel = Panel::new(Axis::linear("Time", "s"), Axis::linear("Voltage", "V"))
        .high(100.0)
        .with(
            Series::line(vec![0.0, 1.0, 2.0], vec![0.0, 1.0, 0.0])
                .label("a")
                .marker(Marker::Right),
        )
        .reference(Along::X, 1.0, Some("here"));
    insta::assert_snapshot!(
        Figure {
            width_px: 300.0,
            ..Figure::new("Small")
        }
        .with(panel)
        .to_svg()
        .unwrap()
    );
}
