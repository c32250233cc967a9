//! Draws every kind of picture. The PNGs remain in the build folder under `tmp/pictures` for
//! inspection.
#![allow(clippy::unwrap_used, reason = "tests")]

mod event_markers;
mod moving_bases;
mod responses;
mod sweeps;

use std::f64::consts::PI;
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
        figure.write(&Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml/figure.svg")),
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
