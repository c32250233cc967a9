//! Test for a closed curve.

use super::{Metric, Position};

/// True when a point lies between two others, with a small distance from their chord.
pub fn lies_between(
    metric: &Metric,
    position: &Position,
    before: &Position,
    after: &Position,
) -> bool {
    let (chord, offset) = (before.to(after), before.to(position));
    let along = metric.inner(&chord, &offset) / metric.inner(&chord, &chord);
    let length = metric.length(&chord);
    let distance = (metric.inner(&offset, &offset) - along * along * length * length)
        .max(0.0)
        .sqrt();
    (0.0..=1.0).contains(&along) && distance < 0.1 * length
}
