//! Positions of labels: near the named element, without overlap with other elements or labels.

use super::rect::Rect;
use crate::text::{SMALL, width};

/// Distance of two lines of text, px.
pub const LINE: f64 = 15.0;

/// A label to be placed.
#[derive(Debug, Clone)]
pub struct LabelRequest {
    /// Named point.
    pub anchor: (f64, f64),
    /// Other points of the named element, at which the leader may start.
    pub others: Vec<(f64, f64)>,
    /// Preferred direction from the anchor.
    pub toward: (f64, f64),
    /// Lines of text.
    pub lines: Vec<String>,
}

/// A placed label.
#[derive(Debug, Clone)]
pub struct Label {
    /// Lines of text.
    pub lines: Vec<String>,
    /// Area of the text.
    pub room: Rect,
    /// Leader from the named element, if the label is not next to it.
    pub leader: Option<[(f64, f64); 2]>,
}

/// A leader is drawn to a label farther away than this, px.
const APART: f64 = 15.0;

/// Cost of a body between a label and its element, px of distance.
const CROSSED: f64 = 200.0;

/// Cost of another leader between a label and its element, px of distance.
const LEADER_CROSSED: f64 = 0.25 * CROSSED;

/// Half the additional cost of a label opposite to its preferred direction, px of distance.
const TURNED: f64 = 60.0;

/// Places every label at the cheapest free position between two edges of the page; labels with a
/// cheap position come first.
pub fn place_labels(
    requests: &[LabelRequest],
    obstacles: &[Rect],
    (left, right): (f64, f64),
) -> Vec<Label> {
    let page = Rect {
        left,
        right,
        top: f64::NEG_INFINITY,
        bottom: f64::INFINITY,
    };
    let first = |request: &LabelRequest| {
        cost(
            request,
            &cheapest(request, obstacles, &[], page),
            obstacles,
            &[],
        )
    };
    let mut order: Vec<(f64, &LabelRequest)> = requests
        .iter()
        .map(|request| (first(request), request))
        .collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut labels: Vec<Label> = Vec::new();
    for (_, request) in order {
        let room = cheapest(request, obstacles, &labels, page);
        let leader = leader(request, &room, obstacles, &labels).map(|(line, _)| line);
        labels.push(Label {
            lines: request.lines.clone(),
            room,
            leader,
        });
    }
    labels
}

/// Returns the width and height of a label.
pub fn size_of(lines: &[String]) -> (f64, f64) {
    (
        lines
            .iter()
            .map(|line| width(line, SMALL))
            .fold(0.0, f64::max),
        LINE * lines.len() as f64,
    )
}

/// True where two line segments cross.
fn cross(one: [(f64, f64); 2], other: [(f64, f64); 2]) -> bool {
    let side = |[from, to]: [(f64, f64); 2], point: (f64, f64)| {
        (to.0 - from.0) * (point.1 - from.1) - (to.1 - from.1) * (point.0 - from.0)
    };
    let parts = |line, ends: [(f64, f64); 2]| side(line, ends[0]) * side(line, ends[1]) < 0.0;
    parts(one, other) && parts(other, one)
}

/// Returns the leader to a label, from the start with the fewest crossings, and its cost. A label
/// next to its anchor has no leader unless an element lies between.
fn leader(
    request: &LabelRequest,
    room: &Rect,
    obstacles: &[Rect],
    labels: &[Label],
) -> Option<([(f64, f64); 2], f64)> {
    let lines = std::iter::once(request.anchor)
        .chain(request.others.iter().copied())
        .map(|from| {
            let to = room.nearest(from);
            let length = distance(from, to);
            // The named element is where the leader starts.
            let other = |body: &&Rect| {
                distance(from, body.nearest(from)) > 1e-6 && body.grown(0.05).crossed(from, to)
            };
            let bodies = obstacles.iter().filter(other).count();
            let leaders = labels.iter().filter_map(|label| label.leader);
            let leaders = leaders.filter(|line| cross(*line, [from, to])).count();
            let names = labels
                .iter()
                .filter(|label| label.room.crossed(from, to))
                .count();
            (
                [from, to],
                CROSSED * bodies as f64 + LEADER_CROSSED * leaders as f64 + 1000.0 * names as f64,
                length,
            )
        });
    let (line, crossed, _) =
        lines.min_by(|one, other| one.1.total_cmp(&other.1).then(one.2.total_cmp(&other.2)))?;
    let near = distance(request.anchor, room.nearest(request.anchor)) <= APART;
    (!near || crossed > 0.0).then_some((line, crossed))
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    (a.0 - b.0).hypot(a.1 - b.1)
}

/// Returns the cheapest free position of a label, or one below everything if there is none.
fn cheapest(request: &LabelRequest, obstacles: &[Rect], labels: &[Label], page: Rect) -> Rect {
    let size = size_of(&request.lines);
    let free = |room: &Rect| {
        let inside = room.left >= page.left && room.right <= page.right;
        inside && is_free(room, obstacles, labels)
    };
    // Centred at the anchor, or with an edge near it, on either side.
    let sides =
        (0..24).flat_map(|i| [-1.0, 1.0].map(|side| side * (0.5 * size.0 + 8.0 * f64::from(i))));
    let across: Vec<f64> = (-16..=16)
        .map(|i| 8.0 * f64::from(i))
        .chain(sides)
        .collect();
    // Searches some columns for the cheapest position with a cost of at most `bound`.
    let search = |columns: &[f64], bound: f64| {
        let mut best: Option<(f64, Rect)> = None;
        // Most positions already cost too much by their distance, before the obstacles are checked.
        let beaten = |best: &Option<(f64, Rect)>, cost: f64| {
            cost > bound || best.as_ref().is_some_and(|(least, _)| cost >= *least)
        };
        for dx in columns {
            if beaten(&best, least((*dx, 0.0), size)) {
                continue;
            }
            for dy in (-45..=45).map(|j| 5.0 * f64::from(j)) {
                let room = Rect::around((request.anchor.0 + dx, request.anchor.1 + dy), size);
                if beaten(&best, least((*dx, dy), size))
                    || beaten(&best, placement_cost(request, &room))
                    || !free(&room)
                {
                    continue;
                }
                let cost = cost(request, &room, obstacles, labels);
                if !beaten(&best, cost) {
                    best = Some((cost, room));
                }
            }
        }
        best
    };
    // A position straight above or below nearly always exists, and leaves few others to be tried.
    let above = search(&[0.0], f64::INFINITY);
    let best = search(&across, above.map_or(f64::INFINITY, |(cost, _)| cost));
    best.map_or_else(
        || below_all(request.anchor, size, (obstacles, labels), page),
        |(_, room)| room,
    )
}

/// True where an area meets no element, no label and no leader.
fn is_free(room: &Rect, obstacles: &[Rect], labels: &[Label]) -> bool {
    let with_margin = room.grown(3.0);
    // Side by side, two names are read as one unless a wide space separates them.
    let with_space = Rect {
        left: room.left - 12.0,
        right: room.right + 12.0,
        ..*room
    };
    !obstacles.iter().any(|other| with_margin.meets(other))
        && !labels.iter().any(|label| {
            with_margin.meets(&label.room)
                || with_space.meets(&label.room)
                || pierced(label, &with_margin)
        })
}

/// Returns the position below all elements and labels, as near to the anchor as the page allows.
fn below_all(
    anchor: (f64, f64),
    size: (f64, f64),
    (obstacles, labels): (&[Rect], &[Label]),
    page: Rect,
) -> Rect {
    let lowest = obstacles
        .iter()
        .chain(labels.iter().map(|label| &label.room))
        .map(|rect| rect.bottom)
        .fold(anchor.1, f64::max);
    let x = anchor.0.clamp(
        page.left + 0.5 * size.0,
        (page.right - 0.5 * size.0).max(page.left + 0.5 * size.0),
    );
    Rect::around((x, lowest + 8.0 + 0.5 * size.1), size)
}

fn pierced(label: &Label, room: &Rect) -> bool {
    label
        .leader
        .is_some_and(|[from, to]| room.crossed(from, to))
}

/// Returns a fast lower bound of [`placement_cost`] for a label of a size at a distance from its
/// anchor, roundoff included.
fn least((dx, dy): (f64, f64), (width, height): (f64, f64)) -> f64 {
    let (across, up) = (dx.abs(), dy.abs());
    (1.0 - 1e-9) * ((across - 0.5 * width).max(up - 0.5 * height).max(0.0) + 0.1 * across.max(up))
}

/// Returns the cost of the distance and of the deviation from the preferred direction.
fn placement_cost(request: &LabelRequest, room: &Rect) -> f64 {
    let middle = (
        0.5 * (room.left + room.right) - request.anchor.0,
        0.5 * (room.top + room.bottom) - request.anchor.1,
    );
    let length = middle.0.hypot(middle.1).max(1.0);
    let along = (middle.0 * request.toward.0 + middle.1 * request.toward.1)
        / (length * request.toward.0.hypot(request.toward.1).max(1e-9));
    distance(request.anchor, room.nearest(request.anchor)) + 0.1 * length + TURNED * (1.0 - along)
}

/// Returns the cost including the crossings of the leader.
fn cost(request: &LabelRequest, room: &Rect, obstacles: &[Rect], labels: &[Label]) -> f64 {
    placement_cost(request, room)
        + leader(request, room, obstacles, labels).map_or(0.0, |(_, crossed)| 10.0 + crossed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_cross_where_each_parts_the_ends_of_the_other() {
        let line = |x: f64| [(x, -1.0), (x, 1.0)];
        let level = [(0.0, 0.0), (2.0, 0.0)];
        let crossings = [-1.0, 1.0, 3.0].map(|x| cross(line(x), level));
        assert_eq!(crossings, [false, true, false]);
    }

    #[test]
    fn labels_at_one_position_do_not_overlap() {
        let request = LabelRequest {
            anchor: (200.0, 100.0),
            others: Vec::new(),
            toward: (0.0, -1.0),
            lines: vec!["one of many".into(), "two lines".into()],
        };
        let obstacle = Rect::between((0.0, 95.0), (400.0, 105.0));
        let labels = place_labels(&vec![request; 40], &[obstacle], (10.0, 390.0));
        for (k, label) in labels.iter().enumerate() {
            assert!(
                !label.room.meets(&obstacle)
                    && label.room.left >= 10.0
                    && label.room.right <= 390.0
            );
            assert!(
                labels[..k]
                    .iter()
                    .all(|other| !other.room.meets(&label.room)),
                "{k}"
            );
        }
        assert!(labels[0].leader.is_none() && labels[0].room.bottom <= 95.0);
    }
}
