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

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomial with leading coefficient one, positive at zero, from its roots and a constant.
    fn polynomial(roots: &[f64], constant: f64) -> Coefficients {
        let mut p = [0.0; ORDER + 1];
        p[0] = 1.0;
        for root in roots {
            for k in (0..=ORDER).rev() {
                p[k] = (if k > 0 { p[k - 1] } else { 0.0 }) - root * p[k];
            }
        }
        let sign = p[0].signum();
        p.iter_mut().for_each(|c| *c *= sign);
        p[0] += constant;
        p
    }

    #[test]
    fn the_first_root_is_found_where_several_follow_closely() {
        for roots in [
            &[0.3, 0.300_001][..],
            &[0.5, 0.7, 0.7, -0.2],
            &[0.9],
            &[0.2, 0.4, 0.6, 0.8, 0.99, 3.0, -1.0],
        ] {
            let found = first_root(&polynomial(roots, 0.0), 1.0, 1e-16).unwrap();
            assert!(
                (found.unwrap() - roots[0]).abs() < 1e-9,
                "{roots:?} {found:?}"
            );
        }
    }

    #[test]
    fn a_minimum_above_zero_and_a_root_past_the_end_are_no_roots() {
        let above = polynomial(&[0.5, 0.5], 1e-9);
        let below = polynomial(&[0.5, 0.5], -1e-9);
        assert_eq!(first_root(&above, 1.0, 1e-16), Ok(None));
        let found = first_root(&below, 1.0, 1e-16).unwrap().unwrap();
        assert!((found - 0.5 + 1e-9_f64.sqrt()).abs() < 1e-9, "{found}");
        assert_eq!(first_root(&polynomial(&[1.001], 0.0), 1.0, 1e-16), Ok(None));
        assert_eq!(first_root(&polynomial(&[], 0.0), 1.0, 1e-16), Ok(None));
    }
}
