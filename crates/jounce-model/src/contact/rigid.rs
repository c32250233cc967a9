//! Rigid stop: the relative velocity reverses instantaneously, `delta'_after = -e delta'_before`
//! (Newton).

/// Instantaneous rebound with a coefficient of restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rigid {
    /// `e`, 0 (no rebound) to 1 (no loss).
    pub restitution: f64,
}
