//! Test for a closed curve.

use super::{Metric, Position};

/// True when a point lies between two others, with a small distance from their chord.
pub fn passes(metric: &Metric, place: &Position, before: &Position, after: &Position) -> bool {
    let (way, home) = (before.to(after), before.to(place));
    let along = metric.inner(&way, &home) / metric.inner(&way, &way);
    let length = metric.length(&way);
    let off = (metric.inner(&home, &home) - along * along * length * length)
        .max(0.0)
        .sqrt();
    (0.0..=1.0).contains(&along) && off < 0.1 * length
}
