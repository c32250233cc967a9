//! Drawings of harvesters with moving bases: an arrow for each.

use std::path::Path;

/// Draws a spec as SVG, and as PNG for inspection; returns the positions of labels that begin with
/// the given words, px.
fn label_positions(name: &str, text: &str, words: &[&str]) -> Vec<(f64, f64)> {
    let drawing = jounce_plot::show::drawing(name, &jounce_spec::Spec::from_toml(text).unwrap());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures");
    std::fs::create_dir_all(&folder).unwrap();
    drawing.write(&folder.join(format!("{name}.png"))).unwrap();
    let svg = drawing.to_svg();
    let label_position = |words: &&str| {
        let end = svg
            .find(&format!(">{words}"))
            .unwrap_or_else(|| panic!("{name}: {words} is not drawn"));
        let label = &svg[svg[..end].rfind("<text").unwrap()..end];
        let number = |key: &str| {
            label
                .split(&format!(" {key}=\""))
                .nth(1)
                .unwrap()
                .split('"')
                .next()
                .unwrap()
                .parse::<f64>()
                .unwrap()
        };
        (number("x"), number("y"))
    };
    words.iter().map(label_position).collect()
}

const MODAL: &str = r#"
[modal.disc]
frequency_hz = [4000.0]
damping_ratio = [0.01]
participation_sqrt_kg = [0.02]
[modal.disc.point]
centre = [50.0]
[drive.blow]
kind = "base-acceleration"
amplitude = "1 g"
frequency = "20 Hz"
"#;

const BEAM: &str = r#"
[damping]
beyond = 0.01
[beam.arm]
material = "aluminium"
length = "120 mm"
width = "20 mm"
thickness = "1 mm"
[stop.hammer]
at = "arm.end"
frame = "ram"
gap = "0.5 mm"
law = "rigid"
restitution = 0.5
[drive.d]
kind = "base-displacement"
at = "ram"
amplitude = "1 mm"
frequency = "15 Hz"
"#;

const TWO_BEAMS: &str = r#"
[damping]
beyond = 0.01
[beam.arm]
material = "steel"
length = "90 mm"
width = "12 mm"
thickness = "0.5 mm"
[beam.arm.point]
half = "45 mm"
[beam.other]
material = "brass"
length = "60 mm"
width = "12 mm"
thickness = "0.8 mm"
root = "head"
[stop.along]
at = "arm.half"
frame = "other.end"
side = "negative"
gap = "5 mm"
law = "rigid"
restitution = 0.5
[drive.x]
kind = "base-displacement"
at = "head"
amplitude = "0.2 mm"
frequency = "40 Hz"
[drive.y]
kind = "base-acceleration"
amplitude = "0.2 g"
frequency = "40 Hz"
"#;

/// Labels of motion are at the moving part: for a structure specified by its modes only, at a stop
/// on a separate base, and at each of two clamps on two bases.
#[test]
fn every_moving_base_has_its_arrow() {
    label_positions("shaken-modes", MODAL, &["blow: "]);
    let [drive, stop] = label_positions(
        "moving-stop",
        BEAM,
        &["d of ram: 1 mm peak", "stop hammer on ram"],
    )[..] else {
        panic!()
    };
    assert!(
        (drive.0 - stop.0).abs() < 150.0,
        "{drive:?} stands away from its stop {stop:?}"
    );
    let [arm, other, head, ground] = label_positions(
        "two-bases",
        TWO_BEAMS,
        &["arm, steel", "on head", "x of head: ", "y: "],
    )[..] else {
        panic!()
    };
    assert!(
        (head.0 - ground.0).abs() > 100.0,
        "{head:?} and {ground:?} are one arrow, beside {arm:?} and {other:?}"
    );
}
