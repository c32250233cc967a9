//! Instant of a step at which a point leaves its stop.

use jounce_simd::{F64x8, LANES};

/// Points of the interpolation: the start of the step, its nodes, and its end.
const POINTS: usize = LANES + 1;

/// Largest number of halvings or secants.
const MAX_ITERATIONS: usize = 40;

/// Part of the step to which the instant is located.
const RESOLUTION: f64 = 1e-13;

/// Returns the last zero of the penetration on a step as a part of its length: that of the polynomial
/// through the start, the nodes and the end, where the penetration is negative.
///
/// `[start, slope]` are penetration and rate times length at the start. A step that starts at the
/// surface has a zero there, which is divided out.
pub(super) fn separation(
    [start, slope]: [f64; 2],
    positions: &[f64; LANES],
    values: &F64x8,
) -> f64 {
    let is_at_surface = start == 0.0;
    let x: [f64; POINTS] = std::array::from_fn(|i| if i == 0 { 0.0 } else { positions[i - 1] });
    let y: [f64; POINTS] = std::array::from_fn(|i| match (i, is_at_surface) {
        (0, true) => slope,
        (0, false) => start,
        (i, true) => values.0[i - 1] / x[i],
        (i, false) => values.0[i - 1],
    });
    let Some(last) = (0..POINTS - 1).rev().find(|i| y[*i] > 0.0) else {
        return 0.0;
    };
    let weights: [f64; POINTS] = std::array::from_fn(|i| {
        let others = (0..POINTS).filter(|j| *j != i);
        others.map(|j| 1.0 / (x[i] - x[j])).product()
    });
    let polynomial = |at: f64| {
        let (mut above, mut below) = (0.0, 0.0);
        for i in 0..POINTS {
            let weight = weights[i] / (at - x[i]);
            above += weight * y[i];
            below += weight;
        }
        above / below
    };
    falling_zero(polynomial, [x[last], y[last]], [x[last + 1], y[last + 1]])
}

/// Zero of a function between a positive and a negative value: false position, in which an end that
/// stays has its value halved (the Illinois method).
fn falling_zero(f: impl Fn(f64) -> f64, mut high: [f64; 2], mut low: [f64; 2]) -> f64 {
    let mut side = 0;
    let mut at = high[0];
    for _ in 0..MAX_ITERATIONS {
        let next = (high[0] * low[1] - low[0] * high[1]) / (low[1] - high[1]);
        // Not a number at a point of the interpolation, where the zero is found.
        let value = f(next);
        let has_converged = (next - at).abs() <= RESOLUTION;
        at = next;
        if value == 0.0 || value.is_nan() || has_converged {
            break;
        }
        if value > 0.0 {
            high = [next, value];
            low[1] *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        } else {
            low = [next, value];
            high[1] *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force_response::basis::SMOOTH_BASIS;

    /// Separation of a motion on a step.
    fn of(motion: impl Fn(f64) -> f64, slope: f64) -> f64 {
        let values = F64x8(SMOOTH_BASIS.positions.map(&motion));
        separation([motion(0.0), slope], &SMOOTH_BASIS.positions, &values)
    }

    #[test]
    fn the_instant_of_a_parabola_is_exact_wherever_it_lies() {
        for end in [0.01, 0.3, 0.5, 0.77, 0.999] {
            // From the surface, and from within the stop.
            assert!((of(|x| x * (end - x), end) - end).abs() < 1e-12, "{end}");
            assert!(
                (of(|x| (x + 0.2) * (end - x), f64::NAN) - end).abs() < 1e-12,
                "{end}"
            );
        }
    }

    #[test]
    fn the_instant_of_a_half_sine_is_found() {
        for end in [0.6_f64, 0.75, 0.9] {
            let angular = std::f64::consts::PI / end;
            let found = of(|x| (angular * x).sin(), angular);
            // Error of the interpolation, w^9 / 9! times the product of the distances from its nine
            // points, over the slope w.
            let bound = angular.powi(8) / 362_880.0 * 2f64.powi(-16);
            assert!((found - end).abs() < bound, "{end} {found} {bound:e}");
        }
    }

    #[test]
    fn a_step_that_never_was_on_the_stop_separates_at_its_start() {
        assert_eq!(of(|x| -0.1 - x, -1.0), 0.0);
        assert_eq!(of(|x| -x, -1.0), 0.0);
    }
}
