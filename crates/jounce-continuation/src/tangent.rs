//! Tangent of a curve: `R_u du + R_p dp = 0`, oriented along a given direction.

use super::{Direction, Linearization, Metric};

/// Returns the unit tangent; `None` where the derivative has lost more than one rank.
pub fn tangent<L: Linearization>(
    local: &L,
    metric: &Metric,
    before: &Direction,
) -> Option<Direction> {
    let (row, corner) = metric.row(before);
    let zero = vec![0.0; row.len()];
    let (unknown, parameter) = local.bordered(&row, corner, &zero, 1.0)?;
    let unit_tangent = Direction { unknown, parameter };
    unit_tangent
        .unknown
        .iter()
        .all(|d| d.is_finite())
        .then(|| metric.unit(unit_tangent))
}
