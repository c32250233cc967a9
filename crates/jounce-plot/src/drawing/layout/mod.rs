//! Layout of the bodies: two bodies of a contact stand opposite to each other at the distance of
//! the gap.

pub(super) mod assembly;
pub(super) mod labels;
pub(super) mod rect;
pub(super) mod scale;

use super::{Drawing, DrawnContact, DrawnPlace, DrawnShape, Seat};
use assembly::{DrawnSpot, assemblies, face, room};
use rect::Rect;

/// Positions of all bodies.
#[derive(Debug, Clone)]
pub struct DrawingLayout {
    /// Pixels per metre.
    pub px_per_m: f64,
    /// Position of each body, relative to the first of its group.
    pub spots: Vec<DrawnSpot>,
    /// Group of each body: bodies connected by contacts.
    pub group: Vec<usize>,
    /// True for each contact whose two sides stand opposite to each other.
    pub opposite: Vec<bool>,
}

impl DrawingLayout {
    /// Lays out all bodies at a scale.
    pub fn at(drawing: &Drawing, px_per_m: f64) -> Self {
        let fixed = assemblies(drawing, px_per_m);
        let count = drawing.bodies.len();
        let mut layout = Self {
            px_per_m,
            spots: fixed.iter().map(|(_, spot)| *spot).collect(),
            group: vec![usize::MAX; count],
            opposite: vec![false; drawing.contacts.len()],
        };
        let feet: Vec<usize> = fixed.iter().map(|(foot, _)| *foot).collect();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|a, b| length(drawing, *b).total_cmp(&length(drawing, *a)));
        let mut groups = 0;
        for body in order {
            if layout.group[body] == usize::MAX {
                layout.take(&feet, feet[body], groups);
                while layout.oppose(drawing, &feet) {}
                groups += 1;
            }
        }
        layout
    }

    /// Returns the number of groups.
    pub fn groups(&self) -> usize {
        self.group.iter().map(|group| group + 1).max().unwrap_or(0)
    }

    /// Returns the bodies of a group.
    pub fn members(&self, group: usize) -> impl Iterator<Item = usize> {
        self.group
            .iter()
            .enumerate()
            .filter(move |(_, of)| **of == group)
            .map(|(body, _)| body)
    }

    /// Returns a place on the sheet: its abscissa and the height of the middle of the body there.
    pub fn point(&self, drawing: &Drawing, position: DrawnPlace) -> (f64, f64) {
        let spot = self.spots[position.body];
        let along = if matches!(drawing.bodies[position.body].shape, DrawnShape::Beam(_)) {
            position.along_m
        } else {
            0.0
        };
        (spot.x + spot.way * along * self.px_per_m, spot.y)
    }

    /// Returns the area of a group with its gaps.
    pub fn extent(&self, drawing: &Drawing, group: usize) -> Rect {
        let bodies = self
            .members(group)
            .map(|body| room(drawing, body, self.spots[body], self.px_per_m));
        let stops = drawing
            .contacts
            .iter()
            .filter(|contact| self.group[contact.at.body] == group)
            .map(|contact| {
                let (x, y) = self.point(drawing, contact.at);
                Rect::between(
                    (x, y),
                    (x, y + sign(contact) * self.reach(drawing, contact)),
                )
            });
        bodies
            .chain(stops)
            .fold(Rect::EMPTY, |all, rect| all.joined(&rect))
    }

    /// Returns the distance from the middle of the striking body to the struck face, px.
    pub fn reach(&self, drawing: &Drawing, contact: &DrawnContact) -> f64 {
        face(drawing, contact.at, contact.above, self.px_per_m) + contact.gap_m * self.px_per_m
    }

    /// Assigns an assembly to a group.
    fn take(&mut self, feet: &[usize], foot: usize, group: usize) {
        feet.iter()
            .enumerate()
            .filter(|(_, of)| **of == foot)
            .for_each(|(body, _)| self.group[body] = group);
    }

    /// Places one more assembly opposite to its contact; false if there is none.
    fn oppose(&mut self, drawing: &Drawing, feet: &[usize]) -> bool {
        for (index, contact) in drawing.contacts.iter().enumerate() {
            let Some(on) = contact.on else { continue };
            let (known, new, sign) = match (self.group[contact.at.body], self.group[on.body]) {
                (usize::MAX, usize::MAX) => continue,
                (_, usize::MAX) => (contact.at, on, sign(contact)),
                (usize::MAX, _) => (on, contact.at, -sign(contact)),
                _ => continue,
            };
            let (x, y) = self.point(drawing, known);
            self.face_each_other(drawing, feet, (known, new), x);
            let distance =
                self.reach(drawing, contact) + face(drawing, on, !contact.above, self.px_per_m);
            let point = self.point(drawing, new);
            self.shift(
                feet,
                feet[new.body],
                (x - point.0, y + sign * distance - point.1),
            );
            self.take(feet, feet[new.body], self.group[known.body]);
            self.opposite[index] = true;
            return true;
        }
        false
    }

    /// Mirrors a new assembly if its clamp would otherwise overlap the placed bodies.
    fn face_each_other(
        &mut self,
        drawing: &Drawing,
        feet: &[usize],
        (known, new): (DrawnPlace, DrawnPlace),
        x: f64,
    ) {
        let foot = feet[new.body];
        let clamped = drawing.bodies[foot].seat == Seat::Ground;
        let root = x - (self.point(drawing, new).0 - self.spots[foot].x);
        let foot_x = self.spots[feet[known.body]].x;
        let long = matches!(drawing.bodies[known.body].shape, DrawnShape::Beam(_))
            || feet[known.body] != known.body;
        if clamped && long && (root - foot_x).abs() > 8.0 {
            let centre = self.spots[foot].x;
            for (body, _) in feet.iter().enumerate().filter(|(_, of)| **of == foot) {
                let spot = &mut self.spots[body];
                (spot.x, spot.way) = (2.0 * centre - spot.x, -spot.way);
            }
        }
    }

    fn shift(&mut self, feet: &[usize], foot: usize, (dx, dy): (f64, f64)) {
        for (body, _) in feet.iter().enumerate().filter(|(_, of)| **of == foot) {
            self.spots[body].x += dx;
            self.spots[body].y += dy;
        }
    }
}

/// Returns -1 if the struck body is above, on a sheet whose heights grow downwards.
pub fn sign(contact: &DrawnContact) -> f64 {
    if contact.above { -1.0 } else { 1.0 }
}

fn length(drawing: &Drawing, body: usize) -> f64 {
    if let DrawnShape::Beam(beam) = &drawing.bodies[body].shape {
        beam.length_m
    } else {
        0.0
    }
}
