//! The largest scale at which all groups have room.

use super::DrawingLayout;
use crate::drawing::{Drawing, DrawnShape, ViewRoom};

/// Width of the room of a group, relative to that of the sheet.
const WIDTH_SHARE: f64 = 560.0 / 900.0;

/// Height of the room of a group, px; the smaller one if only gaps have a length.
const HEIGHTS: [f64; 2] = [400.0, 220.0];

/// Height of the labels of a group, px: about two lines above and one below.
const LABELS: f64 = 60.0;

/// Height of the lengths of a group below which the scale is not reduced, px.
const MIN_HEIGHT: f64 = 40.0;

/// Lays out all bodies at the largest scale at which every group has room; the scale is 0 if the
/// drawing has no lengths.
pub fn fitted(drawing: &Drawing, room: ViewRoom) -> DrawingLayout {
    let beams = drawing
        .bodies
        .iter()
        .any(|body| matches!(body.shape, DrawnShape::Beam(_)));
    let gaps = drawing.contacts.iter().any(|contact| contact.gap_m > 0.0);
    if !(beams || gaps) {
        return DrawingLayout::at(drawing, 0.0);
    }
    let symbols = DrawingLayout::at(drawing, 0.0);
    let group_height = room.height_px / symbols.groups() as f64 - LABELS;
    let fits = |layout: &DrawingLayout| {
        (0..layout.groups()).all(|group| {
            let extent = layout.extent(drawing, group);
            let least = symbols.extent(drawing, group).height() + MIN_HEIGHT;
            let height = group_height.max(least).min(HEIGHTS[usize::from(!beams)]);
            extent.width() <= WIDTH_SHARE * room.width_px && extent.height() <= height
        })
    };
    let (mut low, mut high) = (-9.0_f64, 12.0_f64);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if fits(&DrawingLayout::at(drawing, 10f64.powf(middle))) {
            low = middle
        } else {
            high = middle
        }
    }
    DrawingLayout::at(drawing, 10f64.powf(low))
}
