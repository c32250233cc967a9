//! The largest scale at which all groups have room.

use super::DrawingLayout;
use crate::drawing::{Drawing, DrawnShape};

/// Width of the room of a group on a sheet of the default width, px.
const WIDTH: f64 = 560.0;

/// Height of the room of a group, px; the smaller one if only gaps have a length.
const HEIGHTS: [f64; 2] = [400.0, 220.0];

/// Lays out all bodies at the largest scale at which every group has room; the scale is 0 if the
/// drawing has no lengths. `width_share` is the width of the sheet relative to the default.
pub fn fitted(drawing: &Drawing, width_share: f64) -> DrawingLayout {
    let beams = drawing
        .bodies
        .iter()
        .any(|body| matches!(body.shape, DrawnShape::Beam(_)));
    let gaps = drawing.contacts.iter().any(|contact| contact.gap_m > 0.0);
    if !(beams || gaps) {
        return DrawingLayout::at(drawing, 0.0);
    }
    let height = HEIGHTS[usize::from(!beams)];
    let fits = |layout: &DrawingLayout| {
        (0..layout.groups()).all(|group| {
            let room = layout.extent(drawing, group);
            room.width() <= WIDTH * width_share && room.height() <= height
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
