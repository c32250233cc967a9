//! Movable parts of a drawing, with their positions on the sheet.

use super::layout::assembly::{face, thick};
use super::layout::rect::Rect;
use super::layout::{DrawingLayout, sign};
use super::parts::close_up::{self, CloseUpSize};
use super::parts::contacts::PIN;
use super::{Drawing, DrawnShape};

/// A drawing with the positions of its parts, px from its upper left corner.
#[derive(Debug, Clone, PartialEq)]
pub struct GripSheet {
    /// SVG document.
    pub svg: String,
    /// Side view with its scale bar.
    pub side: Rect,
    /// Circuits.
    pub circuits: Vec<Rect>,
    /// Close-ups.
    pub looks: Vec<Rect>,
    /// Plan views of plates.
    pub plans: Vec<Rect>,
    /// Movable parts.
    pub grips: Vec<Grip>,
}

/// A movable part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// Part.
    pub part: GripPart,
    /// Position, px.
    pub at: (f64, f64),
    /// Derivative of the position by the length, px/m.
    pub px_per_m: (f64, f64),
}

/// Kind of a movable part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripPart {
    /// End of a patch near the root, by the indices of body and patch; it grows with the distance
    /// from the root.
    PatchStart {
        /// Index of the body.
        body: usize,
        /// Index of the patch on it.
        patch: usize,
    },
    /// Other end of a patch; it grows with the length of the patch.
    PatchEnd {
        /// Index of the body.
        body: usize,
        /// Index of the patch on it.
        patch: usize,
    },
    /// Position of a contact along its beam; it grows with the distance from the root.
    Place {
        /// Index of the contact.
        contact: usize,
    },
    /// Struck face of a contact; it grows with the gap.
    Gap {
        /// Index of the contact.
        contact: usize,
    },
}

/// Returns all grips; `shifts` are those of the groups from the layout to the sheet, `looks` the
/// close-ups in the order of their contacts.
pub fn grips(
    drawing: &Drawing,
    layout: &DrawingLayout,
    shifts: &[(f64, f64)],
    close_ups: &[Rect],
) -> Vec<Grip> {
    let mut grips = Vec::new();
    for body in 0..drawing.bodies.len() {
        grips.extend(patches(drawing, layout, body, shifts[layout.group[body]]));
    }
    let mut close_ups = close_ups.iter();
    for (index, contact) in drawing.contacts.iter().enumerate() {
        let shift = shifts[layout.group[contact.at.body]];
        let (x, middle) = layout.point(drawing, contact.at);
        let (x, middle, sign) = (x + shift.0, middle + shift.1, sign(contact));
        let stop_face = middle + sign * layout.reach(drawing, contact);
        if matches!(drawing.bodies[contact.at.body].shape, DrawnShape::Beam(_)) {
            let along = layout.spots[contact.at.body].way * layout.px_per_m;
            let near = middle + sign * face(drawing, contact.at, contact.above, layout.px_per_m);
            let y = if layout.opposite[index] {
                0.5 * (near + stop_face)
            } else {
                stop_face + sign * 0.7 * PIN
            };
            grips.push(Grip {
                part: GripPart::Place { contact: index },
                at: (x, y),
                px_per_m: (along, 0.0),
            });
        }
        let part = GripPart::Gap { contact: index };
        if close_up::needed(contact, layout.px_per_m) {
            let Some(close_up) = close_ups.next() else {
                continue;
            };
            let (at, px_per_m) =
                CloseUpSize::of(drawing, contact).grip((close_up.left, close_up.top));
            grips.push(Grip {
                part,
                at,
                px_per_m: (0.0, px_per_m),
            });
        } else if layout.px_per_m > 0.0 {
            grips.push(Grip {
                part,
                at: (x, stop_face),
                px_per_m: (0.0, sign * layout.px_per_m),
            });
        }
    }
    grips
}

/// Returns the ends of the patches on a body.
fn patches(drawing: &Drawing, layout: &DrawingLayout, body: usize, shift: (f64, f64)) -> Vec<Grip> {
    let DrawnShape::Beam(beam) = &drawing.bodies[body].shape else {
        return Vec::new();
    };
    let (spot, px_per_m) = (layout.spots[body], layout.px_per_m);
    let ends = beam
        .patches
        .iter()
        .enumerate()
        .flat_map(|(patch, covering)| {
            let side = if covering.top { -1.0 } else { 1.0 };
            let y = spot.y
                + shift.1
                + side
                    * 0.5
                    * (thick(beam.thickness_m, px_per_m) + thick(covering.thickness_m, px_per_m));
            let at = |along_m: f64| (spot.x + shift.0 + spot.way * along_m * px_per_m, y);
            let grip = |part, along_m| Grip {
                part,
                at: at(along_m),
                px_per_m: (spot.way * px_per_m, 0.0),
            };
            let (start_m, end_m) = (covering.start_m, covering.start_m + covering.length_m);
            [
                grip(GripPart::PatchStart { body, patch }, start_m),
                grip(GripPart::PatchEnd { body, patch }, end_m),
            ]
        });
    ends.collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::SpecFile;

    /// Returns the drawing of the paper's harvester with some overrides, and the grip of a part.
    fn gripped(set: &[(&str, &str)], part: GripPart) -> (GripSheet, Grip) {
        let mut file = SpecFile::read(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/impact-harvester-2019/harvester.toml"
        ))
        .unwrap();
        set.iter()
            .for_each(|(key, value)| file.set(key, value).unwrap());
        let sheet = crate::show::drawing("", &file.spec().unwrap()).sheet();
        let grip = *sheet
            .grips
            .iter()
            .find(|grip| grip.part == part)
            .unwrap_or_else(|| panic!("{part:?}: {:?}", sheet.grips));
        (sheet, grip)
    }

    /// The stated motion of a grip agrees with the drawing of a longer length.
    #[test]
    fn parts_move_as_their_grips_say() {
        let patch = (1, 0);
        let moves = [
            (
                GripPart::PatchStart {
                    body: patch.0,
                    patch: patch.1,
                },
                "patch.mfc.start",
                0.0,
                20e-3,
            ),
            (
                GripPart::PatchEnd {
                    body: patch.0,
                    patch: patch.1,
                },
                "patch.mfc.length",
                85e-3,
                20e-3,
            ),
            (
                GripPart::Place { contact: 0 },
                "beam.beam.point.tip",
                305e-3,
                -30e-3,
            ),
        ];
        for (part, key, before_m, by_m) in moves {
            let start = format!("{} m", before_m);
            let end = format!("{} m", before_m + by_m);
            let (a, b) = (
                gripped(&[(key, &start)], part).1,
                gripped(&[(key, &end)], part).1,
            );
            assert!(
                (b.at.0 - a.at.0 - by_m * a.px_per_m.0).abs() < 0.02 && a.px_per_m.1 == 0.0,
                "{key}: {a:?} {b:?}"
            );
        }
        // The grip of a small gap is in its close-up, of a large one in the side view; both where
        // the stop is drawn.
        for (gap, inside) in [("1 mm", true), ("20 mm", false)] {
            let (sheet, grip) = gripped(&[("stop.tip.gap", gap)], GripPart::Gap { contact: 0 });
            let close_up = sheet.looks.first().is_some_and(|close_up| {
                close_up
                    .grown(0.1)
                    .meets(&Rect::around(grip.at, (0.1, 0.1)))
            });
            assert_eq!(close_up, inside, "{grip:?} {sheet:?}");
            assert!(grip.px_per_m.1 < 0.0, "the stop stands above");
            assert!(inside || sheet.side.meets(&Rect::around(grip.at, (0.1, 0.1))));
        }
    }
}
