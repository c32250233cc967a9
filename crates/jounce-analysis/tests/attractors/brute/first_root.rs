//! First root of a polynomial, without missing one.

use super::taylor::{Coefficients, ORDER};

/// Largest number of steps towards a root.
const MOST_STEPS: usize = 200;

/// Value and slope of a polynomial.
#[inline(always)]
pub fn value_and_slope(p: &Coefficients, x: f64) -> [f64; 2] {
    let (mut value, mut slope) = (p[ORDER], 0.0);
    for k in (0..ORDER).rev() {
        slope = slope * x + value;
        value = value * x + p[k];
    }
    [value, slope]
}

/// Returns the first point in `(0, end]` where a polynomial that is positive at zero has fallen to
/// `small`: `Ok(None)` without one, an error where the steps do not suffice.
///
/// A step goes to the root of `p + p' x - b x^2 / 2`, where `-b` is a lower bound of the second
/// derivative between zero and `end`: the sum of its negative terms at `end`. The polynomial has no
/// root before it.
pub fn first_root(p: &Coefficients, end: f64, small: f64) -> Result<Option<f64>, ()> {
    let (mut bend, mut power) = (0.0, 1.0);
    for (k, coefficient) in p.iter().enumerate().skip(2) {
        bend += (k * (k - 1)) as f64 * (-coefficient).max(0.0) * power;
        power *= end;
    }
    let mut x = 0.0;
    for _ in 0..MOST_STEPS {
        let [value, slope] = value_and_slope(p, x);
        if value <= small {
            return Ok(Some(x));
        }
        let root = (slope * slope + 2.0 * bend * value).sqrt();
        let step = if slope > 0.0 {
            (slope + root) / bend
        } else {
            2.0 * value / (root - slope)
        };
        // Infinite without a root.
        if x + step > end {
            return Ok(None);
        }
        x += step;
    }
    Err(())
}
