//! Assemblies: bodies fixed to other bodies, each at its position relative to its carrier.

use super::rect::Rect;
use crate::drawing::{Drawing, DrawnBeam, DrawnPatch, DrawnPlace, DrawnShape, Seat};

/// Size of a mass, px.
pub const BLOCK: (f64, f64) = (86.0, 44.0);
/// Size of a mass fixed to a beam, px.
const TIP: (f64, f64) = (30.0, 30.0);
/// Diameter of a free mass, px.
pub const BALL: f64 = 28.0;
/// Size of a structure given by its modes, px.
const GIVEN: (f64, f64) = (150.0, 50.0);
/// Length of a spring, px.
pub const SPRING: f64 = 38.0;
/// Distance of two beams on one mass, and of a beam from a carrier along its length, px.
const STEP: f64 = 40.0;

/// Position of a body: the root of a beam on its mid-plane, the middle of other bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DrawnSpot {
    /// Abscissa, px.
    pub x: f64,
    /// Height, px, growing downwards.
    pub y: f64,
    /// 1 where a beam extends to the right, -1 to the left.
    pub way: f64,
}

/// Returns the position of every body relative to the foot of its assembly, and the index of the
/// foot.
pub fn assemblies(drawing: &Drawing, px_per_m: f64) -> Vec<(usize, DrawnSpot)> {
    let count = drawing.bodies.len();
    let mut spots: Vec<Option<(usize, DrawnSpot)>> = (0..count)
        .map(|k| {
            carrier(drawing, k).is_none().then_some((
                k,
                DrawnSpot {
                    way: 1.0,
                    ..DrawnSpot::default()
                },
            ))
        })
        .collect();
    let mut rank_on = vec![0_usize; count];
    for _ in 0..count {
        for k in 0..count {
            let Some(support) = carrier(drawing, k).filter(|_| spots[k].is_none()) else {
                continue;
            };
            if let Some((foot, spot)) = spots[support.body] {
                let rank = rank_on[support.body];
                rank_on[support.body] += 1;
                spots[k] = Some((
                    foot,
                    beside_support(drawing, k, support, spot, rank, px_per_m),
                ));
            }
        }
    }
    // A spec with circular supports is refused elsewhere; here each of its bodies is an assembly.
    spots
        .into_iter()
        .enumerate()
        .map(|(k, spot)| {
            spot.unwrap_or((
                k,
                DrawnSpot {
                    way: 1.0,
                    ..DrawnSpot::default()
                },
            ))
        })
        .collect()
}

/// Returns the place that carries a body.
pub fn carrier(drawing: &Drawing, body: usize) -> Option<DrawnPlace> {
    match drawing.bodies[body].seat {
        Seat::On(support) | Seat::Spring(Some(support)) => {
            Some(support).filter(|support| support.body < drawing.bodies.len())
        }
        Seat::Ground | Seat::Spring(None) | Seat::Nothing => None,
    }
}

/// Returns the position of a body on a place of another body at `on`; `rank` bodies are on it
/// already.
fn beside_support(
    drawing: &Drawing,
    body: usize,
    support: DrawnPlace,
    on: DrawnSpot,
    rank: usize,
    px_per_m: f64,
) -> DrawnSpot {
    let x = on.x + on.way * support.along_m * px_per_m;
    let half = 0.5 * size(drawing, support.body).1;
    let half_size = 0.5 * size(drawing, body).1;
    let sprung = matches!(drawing.bodies[body].seat, Seat::Spring(_));
    match (
        &drawing.bodies[body].shape,
        &drawing.bodies[support.body].shape,
    ) {
        (DrawnShape::Beam(_), DrawnShape::Beam(beam)) => {
            let amid = support.along_m < 0.999 * beam.length_m;
            DrawnSpot {
                x,
                y: on.y - if amid { STEP } else { 0.0 },
                way: on.way,
            }
        }
        (DrawnShape::Beam(_), _) => {
            let sign = if rank.is_multiple_of(2) { 1.0 } else { -1.0 };
            DrawnSpot {
                x: on.x + sign * 0.5 * size(drawing, support.body).0,
                y: on.y - STEP * (rank / 2) as f64,
                way: sign,
            }
        }
        (_, DrawnShape::Beam(_)) if sprung => DrawnSpot {
            x,
            y: on.y - SPRING - half_size,
            way: 1.0,
        },
        (_, DrawnShape::Beam(_)) => DrawnSpot {
            x,
            y: on.y,
            way: 1.0,
        },
        _ => DrawnSpot {
            x: on.x,
            y: on.y - half - half_size - if sprung { SPRING } else { 0.0 },
            way: 1.0,
        },
    }
}

/// Returns the width and height of a body that is a symbol; zero for a beam.
pub fn size(drawing: &Drawing, body: usize) -> (f64, f64) {
    let on_beam = || {
        carrier(drawing, body).is_some_and(|support| {
            matches!(drawing.bodies[support.body].shape, DrawnShape::Beam(_))
        })
    };
    match drawing.bodies[body].shape {
        DrawnShape::Beam(_) => (0.0, 0.0),
        DrawnShape::Block if on_beam() && matches!(drawing.bodies[body].seat, Seat::On(_)) => TIP,
        DrawnShape::Block => BLOCK,
        DrawnShape::Ball => (BALL, BALL),
        DrawnShape::Given => GIVEN,
    }
}

/// Returns the area of a body. A sprung mass with contacts on both sides is shifted sideways,
/// so that its spring is clear of them.
pub fn room(drawing: &Drawing, body: usize, spot: DrawnSpot, px_per_m: f64) -> Rect {
    match &drawing.bodies[body].shape {
        DrawnShape::Beam(beam) => {
            let (above, below) = (
                thickness(beam, None, true, px_per_m),
                thickness(beam, None, false, px_per_m),
            );
            let end = spot.x + spot.way * beam.length_m * px_per_m;
            Rect::between((spot.x, spot.y - above), (end, spot.y + below))
        }
        _ => {
            let offset = if sides(drawing, body) == (true, true)
                && drawing.bodies[body].seat == Seat::Spring(None)
            {
                22.0
            } else {
                0.0
            };
            Rect::around((spot.x + offset, spot.y), size(drawing, body))
        }
    }
}

/// Returns the distance of a face of a beam with its patches from the mid-plane, px: at a place, or
/// the largest.
fn thickness(beam: &DrawnBeam, along_m: Option<f64>, top: bool, px_per_m: f64) -> f64 {
    let covers_position =
        |cover: &&DrawnPatch| cover.top == top && along_m.is_none_or(|x| covers(cover, x));
    let layers = beam
        .layers
        .iter()
        .filter(covers_position)
        .map(|layer| thick(layer.thickness_m, px_per_m));
    let patches = beam
        .patches
        .iter()
        .filter(covers_position)
        .map(|patch| under(beam, patch, px_per_m) + thick(patch.thickness_m, px_per_m));
    0.5 * thick(beam.thickness_m, px_per_m) + layers.chain(patches).fold(0.0, f64::max)
}

/// Returns the thickness of the layer under a patch, px.
pub fn under(beam: &DrawnBeam, patch: &DrawnPatch, px_per_m: f64) -> f64 {
    let carries = |layer: &&DrawnPatch| {
        layer.top == patch.top && covers(layer, patch.start_m + 0.5 * patch.length_m)
    };
    beam.layers
        .iter()
        .filter(carries)
        .map(|layer| thick(layer.thickness_m, px_per_m))
        .fold(0.0, f64::max)
}

/// True where a patch or a layer lies at a place.
pub fn covers(cover: &DrawnPatch, along_m: f64) -> bool {
    (cover.start_m..=cover.start_m + cover.length_m * (1.0 + 1e-9)).contains(&along_m)
}

/// Returns a thickness in pixels, at least one.
pub fn thick(length_m: f64, px_per_m: f64) -> f64 {
    (length_m * px_per_m).max(1.0)
}

/// Returns the distance of the upper or lower face at a place from the middle of the body; a mass
/// fixed there is part of it.
pub fn face(drawing: &Drawing, support: DrawnPlace, above: bool, px_per_m: f64) -> f64 {
    let DrawnShape::Beam(beam) = &drawing.bodies[support.body].shape else {
        return 0.5 * size(drawing, support.body).1;
    };
    let is_fixed_there = |other: &usize| {
        drawing.bodies[*other].seat == Seat::On(support)
            && drawing.bodies[*other].shape == DrawnShape::Block
    };
    let fixed = (0..drawing.bodies.len())
        .filter(is_fixed_there)
        .map(|other| 0.5 * size(drawing, other).1);
    fixed.fold(
        thickness(beam, Some(support.along_m), above, px_per_m),
        f64::max,
    )
}

/// Returns two flags: contact above and contact below the body.
pub fn sides(drawing: &Drawing, body: usize) -> (bool, bool) {
    let mut sides = (false, false);
    for contact in &drawing.contacts {
        let other_above = match contact.on {
            _ if contact.at.body == body => contact.above,
            Some(on) if on.body == body => !contact.above,
            _ => continue,
        };
        if other_above {
            sides.0 = true
        } else {
            sides.1 = true
        }
    }
    sides
}
