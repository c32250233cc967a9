//! Labels, leaders and the scale of drawings.

use super::*;
use crate::text::width;
use jounce_spec::{Spec, SpecFile};
use std::path::{Path, PathBuf};

/// Returns the value of an attribute of an element.
fn number(element: &str, name: &str) -> f64 {
    element
        .split(&format!(" {name}=\""))
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap()
        .parse()
        .unwrap()
}

/// Returns every text with its area.
fn texts(svg: &str) -> Vec<(Rect, String)> {
    let labels = svg.split("<text").skip(1).map(|element| {
        let text = element
            .split('>')
            .nth(1)
            .unwrap()
            .trim_end_matches("</text")
            .replace("&quot;", "\"");
        let (x, y, size) = (
            number(element, "x"),
            number(element, "y"),
            number(element, "font-size"),
        );
        let text_width = width(&text, size);
        let left = if element.contains("\"middle\"") {
            x - 0.5 * text_width
        } else {
            x
        };
        (
            Rect {
                left,
                right: left + text_width,
                top: y - 0.75 * size,
                bottom: y + 0.2 * size,
            },
            text,
        )
    });
    labels.collect()
}

fn specs(folder: &Path) -> Vec<PathBuf> {
    let paths = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut spec_paths: Vec<PathBuf> = Vec::new();
    for path in paths {
        match path.is_dir() {
            true => spec_paths.extend(specs(&path)),
            false
                if path.extension().is_some_and(|ending| ending == "toml")
                    && ![
                        "expected.toml",
                        "measured.toml",
                        "study.toml",
                        "design.toml",
                    ]
                    .iter()
                    .any(|name| path.ends_with(name)) =>
            {
                spec_paths.push(path)
            }
            false => (),
        }
    }
    spec_paths.sort();
    spec_paths
}

/// Returns every example and starter with its path.
fn all_specs() -> Vec<(PathBuf, Spec)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let all = [
        specs(&root.join("../../examples")),
        specs(&root.join("../jounce-spec/src/starter")),
    ]
    .concat();
    assert!(all.len() > 20, "{all:?}");
    let read = |path: PathBuf| {
        let spec = SpecFile::read(&path).unwrap().spec();
        let spec = spec.unwrap_or_else(|faults| panic!("{}: {faults}", path.display()));
        (path, spec)
    };
    all.into_iter().map(read).collect()
}

/// Fails where a label lies over another or leaves the sheet.
fn assert_labels_are_free(svg: &str, of: &str) {
    let page = Rect::between((0.0, 0.0), (number(svg, "width"), number(svg, "height")));
    let texts = texts(svg);
    for (k, (room, text)) in texts.iter().enumerate() {
        assert!(
            page.joined(room) == page,
            "{of}: \"{text}\" leaves the page: {room:?}"
        );
        let over = texts[..k].iter().find(|(other, _)| other.meets(room));
        assert!(over.is_none(), "{of}: \"{text}\" lies over {over:?}");
    }
}

#[test]
fn no_label_of_any_example_or_starter_lies_over_another_or_leaves_the_page() {
    for (path, spec) in all_specs() {
        let of = path.display().to_string();
        assert_labels_are_free(&crate::show::drawing("title", &spec).to_svg(), &of);
    }
}

/// Rooms of a live page: low next to other views, and narrow on a telephone.
#[test]
fn plates_in_a_small_room_are_smaller_and_their_labels_are_not() {
    let plates = all_specs().into_iter();
    let plates = plates.filter(|(_, spec)| !spec.plate.is_empty());
    let mut highest_default = 0.0_f64;
    for (path, spec) in plates {
        let drawing = crate::show::drawing("title", &spec);
        let plan = |sheet: &GripSheet| sheet.plans[0];
        highest_default = highest_default.max(plan(&drawing.sheet()).height());
        for (width_px, height_px) in [(395.0, 182.0), (360.0, f64::INFINITY)] {
            let of = format!("{} in {width_px} px", path.display());
            let room = ViewRoom {
                width_px,
                height_px,
            };
            let sheet = drawing.sheet_in(room);
            assert_labels_are_free(&sheet.svg, &of);
            let plan = plan(&sheet);
            assert!(plan.height() < height_px + 1e-6, "{of}: {plan:?}");
            assert!(plan.width() <= width_px - 2.0 * EDGE, "{of}: {plan:?}");
        }
    }
    assert!(highest_default > 300.0, "{highest_default}");
}

/// Returns the ends of every thin straight line.
fn thin_lines(svg: &str) -> Vec<[(f64, f64); 2]> {
    let paths = svg
        .split("<path")
        .filter_map(|element| element.split_once('>'))
        .filter(|(element, _)| element.contains("jounce-grid"));
    let ends = paths.filter_map(|(element, _)| {
        let steps = element.split("d=\"M").nth(1)?.split('"').next()?;
        let points: Vec<f64> = steps
            .split(['L', ' '])
            .filter_map(|number| number.parse().ok())
            .collect();
        if let [a, b, c, d] = points[..] {
            Some([(a, b), (c, d)])
        } else {
            None
        }
    });
    ends.collect()
}

/// No leader crosses a beam, its own or another.
#[test]
fn no_leader_of_any_example_or_starter_crosses_a_beam() {
    let mut leader_count = 0;
    for (path, spec) in all_specs() {
        let sheet = crate::show::drawing("title", &spec).sheet();
        let leaders: Vec<_> = thin_lines(&sheet.svg)
            .into_iter()
            .filter(|[from, _]| from.1 < sheet.side.bottom)
            .collect();
        leader_count += leaders.len();
        for element in sheet
            .svg
            .split("<rect")
            .filter(|element| element.contains("jounce-beam"))
        {
            let (x, y) = (number(element, "x"), number(element, "y"));
            let beam = Rect::between(
                (x, y),
                (x + number(element, "width"), y + number(element, "height")),
            )
            .grown(-0.05);
            let crossing = leaders.iter().find(|[from, to]| beam.crossed(*from, *to));
            assert!(
                crossing.is_none(),
                "{}: {crossing:?} crosses {beam:?}",
                path.display()
            );
        }
    }
    assert!(leader_count > 20, "{leader_count} lines");
}

/// Returns the four edges of a rectangle.
fn edges(element: &str) -> [[(f64, f64); 2]; 4] {
    let (x, y) = (number(element, "x"), number(element, "y"));
    let (right, bottom) = (x + number(element, "width"), y + number(element, "height"));
    let corners = [(x, y), (right, y), (right, bottom), (x, bottom)];
    [0, 1, 2, 3].map(|k| [corners[k], corners[(k + 1) % 4]])
}

/// No label lies over a leader, an edge of a body or of a patch of a plate.
#[test]
fn no_label_lies_over_a_line() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let all = [
        specs(&root.join("../../examples")),
        specs(&root.join("../jounce-spec/src/starter")),
    ];
    for path in all.concat() {
        let mut file = SpecFile::read(&path).unwrap();
        let rides = file.set("stop.tip.frame", "table").is_ok() && file.spec().is_ok();
        let files = match rides {
            true => vec![SpecFile::read(&path).unwrap(), file],
            false => vec![SpecFile::read(&path).unwrap()],
        };
        for file in files {
            let svg = crate::show::drawing("title", &file.spec().unwrap()).to_svg();
            // The close-ups are pictures with coordinates of their own.
            let parts = svg.split("<svg").skip(1).enumerate();
            let outside: String = parts
                .filter_map(|(number, part)| match number {
                    0 => Some(part),
                    _ => Some(part.split_once("</svg>")?.1),
                })
                .collect();
            let rectangles = outside
                .split("<rect")
                .filter_map(|rest| rest.split_once('>'));
            let bodies = rectangles.map(|(element, _)| element).filter(|element| {
                element.contains("jounce-body") || element.contains("jounce-patch")
            });
            let lines = bodies.flat_map(edges).chain(thin_lines(&svg));
            let lines: Vec<[(f64, f64); 2]> = lines.collect();
            for (room, text) in texts(&svg) {
                let over = lines.iter().find(|[from, to]| room.crossed(*from, *to));
                assert!(
                    over.is_none(),
                    "{}: \"{text}\" lies over {over:?}",
                    path.display()
                );
            }
        }
    }
}

/// Returns the width and height of the first rectangle of a class.
fn rectangle(svg: &str, class: &str) -> (f64, f64) {
    let element = svg
        .split("<rect")
        .find(|element| element.contains(&format!("class=\"{class}\"")))
        .unwrap();
    (number(element, "width"), number(element, "height"))
}

#[test]
fn length_thickness_and_gap_have_one_scale() {
    let beams = "[beam.a]\nmaterial = \"steel\"\nlength = \"300 mm\"\nwidth = \"10 mm\"\nthickness = \"6 mm\"\n\
        [stop.tip]\nat = \"a.end\"\nlaw = \"rigid\"\nrestitution = 1\ngap = \"2 mm\"\n[damping]\nbeyond = 0.01\n";
    let svg = crate::show::drawing("", &SpecFile::from_text(beams).spec().unwrap()).to_svg();
    let (length, thickness) = rectangle(&svg, "jounce-beam");
    assert!(
        (thickness / length - 0.02).abs() < 1e-4,
        "{length} {thickness}"
    );
    // The tip starts where the gap above the beam ends.
    let beam = svg
        .split("<rect")
        .find(|element| element.contains("jounce-beam"))
        .unwrap();
    let tip = svg
        .split("<path")
        .find(|element| element.contains("jounce-stop"))
        .unwrap();
    let impact_length: f64 = tip
        .split('Q')
        .nth(1)
        .unwrap()
        .split(' ')
        .nth(1)
        .unwrap()
        .parse()
        .unwrap();
    assert!(
        ((number(beam, "y") - impact_length) / length - 2.0 / 300.0).abs() < 1e-4,
        "{svg}"
    );
    assert!(
        svg.contains("gap 2 mm") && svg.contains("drawn 4 times larger than above"),
        "{svg}"
    );
}
