//! The largest scale at which everything has room.

use super::layout::DrawingLayout;
use super::{Drawing, DrawnShape};

/// Room for a group, px.
const WIDTH: f64 = 560.0;

/// Room for the height of a group, px; less where only gaps have a length.
const HEIGHTS: [f64; 2] = [400.0, 220.0];

/// All bodies at the largest scale at which every group has room; the scale is 0 where nothing has a length.
pub fn fitted(drawing: &Drawing) -> DrawingLayout {
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
            room.width() <= WIDTH && room.height() <= height
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
