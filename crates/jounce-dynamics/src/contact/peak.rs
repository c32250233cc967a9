//! Highest value inside a step: of the penetration, or of the force.

use crate::force_response::basis::{NODES, SMOOTH_BASIS};
use jounce_simd::F64x8;
use std::sync::LazyLock;

/// Points of the interpolation: the start of the step, its nodes, and its end.
const INTERPOLATION_POINTS: usize = NODES + 2;

/// Positions of the points, and Chebyshev coefficients of the polynomials that are 1 at one point
/// and 0 at the others.
struct Interpolation {
    positions: [f64; INTERPOLATION_POINTS],
    coefficients: [[f64; INTERPOLATION_POINTS]; INTERPOLATION_POINTS],
}

static INTERPOLATION: LazyLock<Interpolation> = LazyLock::new(|| {
    let places: [f64; INTERPOLATION_POINTS] = std::array::from_fn(|i| match i {
        0 => 0.0,
        i if i <= NODES => SMOOTH_BASIS.positions[i - 1],
        _ => 1.0,
    });
    let values = jounce_linalg::Mat::from_fn(INTERPOLATION_POINTS, INTERPOLATION_POINTS, |i, n| {
        (n as f64 * (2.0 * places[i] - 1.0).acos()).cos()
    });
    let inverse = jounce_linalg::inverse(&values);
    Interpolation {
        positions: places,
        coefficients: std::array::from_fn(|n| std::array::from_fn(|i| inverse[(n, i)])),
    }
});

/// Returns the maximum over the step of the polynomial through the start value and the lanes (seven
/// smooth nodes and the end). Newton on its slope starts at the top of the parabola through the
/// highest point and its neighbours.
pub fn interpolated_peak(start: f64, values: &F64x8) -> f64 {
    let Interpolation {
        positions,
        coefficients,
    } = &*INTERPOLATION;
    let heights: [f64; INTERPOLATION_POINTS] =
        std::array::from_fn(|i| if i == 0 { start } else { values.0[i - 1] });
    let series: [f64; INTERPOLATION_POINTS] = std::array::from_fn(|n| {
        (0..INTERPOLATION_POINTS)
            .map(|i| coefficients[n][i] * heights[i])
            .sum()
    });
    let top = (0..INTERPOLATION_POINTS).fold(
        0,
        |best, i| if heights[i] > heights[best] { i } else { best },
    );
    let (low, high) = (
        positions[top.saturating_sub(1)],
        positions[(top + 1).min(INTERPOLATION_POINTS - 1)],
    );
    let mut x = positions[top];
    for _ in 0..6 {
        let [_, slope, curvature] = chebyshev(&series, x);
        let next = x - slope / curvature;
        if curvature >= 0.0 || !next.is_finite() {
            break;
        }
        x = next.clamp(low, high);
    }
    chebyshev(&series, x)[0].max(heights[top])
}

/// Returns value, slope and curvature in `x` of a Chebyshev series on `[0, 1]`.
fn chebyshev(series: &[f64; INTERPOLATION_POINTS], x: f64) -> [f64; 3] {
    let s = 2.0 * x - 1.0;
    let (mut before, mut now) = ([1.0, 0.0, 0.0], [s, 2.0, 0.0]);
    let mut sum: [f64; 3] = std::array::from_fn(|d| series[0] * before[d] + series[1] * now[d]);
    for c in &series[2..] {
        let next = [
            2.0 * s * now[0] - before[0],
            2.0 * (2.0 * now[0] + s * now[1]) - before[1],
            2.0 * (4.0 * now[1] + s * now[2]) - before[2],
        ];
        (0..3).for_each(|d| sum[d] += c * next[d]);
        (before, now) = (now, next);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_top_of_a_sine_between_nodes() {
        let sine = |x: f64| (2.0 * x + 0.3).sin();
        let lane = F64x8(SMOOTH_BASIS.positions.map(sine));
        // Ninth derivative 2^9 over 9! times the node polynomial, at most 7.6e-6: 1.1e-8.
        assert!((interpolated_peak(sine(0.0), &lane) - 1.0).abs() < 1.1e-8);
    }
}
