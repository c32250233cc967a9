//! Roots of scalar equations, to roundoff.

/// Returns the root of `value` between two points where its signs differ, by bisection until no
/// number lies between them.
pub(super) fn between(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rises = value(high) > 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        match (value(middle) > 0.0) == rises {
            true => high = middle,
            false => low = middle,
        }
    }
}
