//! Highest penetration inside a step.

use super::collocation::{COLLOCATION, NODES};
use super::lane::Lane;

/// Points of the interpolation: the start of the step, its nodes, and its end.
const POINTS: usize = NODES + 2;

/// Maximum over the step of the polynomial through the start value and the lane (seven nodes and the end), by golden-section
/// search around the highest point.
pub fn interpolated_peak(start: f64, values: &Lane) -> f64 {
    let c = &*COLLOCATION;
    let places: [f64; POINTS] = std::array::from_fn(|i| match i {
        0 => 0.0,
        i if i <= NODES => c.nodes[i - 1],
        _ => 1.0,
    });
    let heights: [f64; POINTS] = std::array::from_fn(|i| if i == 0 { start } else { values.0[i - 1] });
    let weights: [f64; POINTS] = std::array::from_fn(|i| (0..POINTS).filter(|j| *j != i).map(|j| 1.0 / (places[i] - places[j])).product());
    // Barycentric form of the interpolation polynomial.
    let at = |x: f64| {
        let (mut above, mut below) = (0.0, 0.0);
        for i in 0..POINTS {
            if x == places[i] {
                return heights[i];
            }
            let share = weights[i] / (x - places[i]);
            above += share * heights[i];
            below += share;
        }
        above / below
    };
    let highest = (0..POINTS).max_by(|&i, &j| heights[i].total_cmp(&heights[j])).unwrap_or(0);
    let (mut low, mut high) = (places[highest.saturating_sub(1)], places[(highest + 1).min(POINTS - 1)]);
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    while high - low > 1e-7 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if at(a) > at(b) { high = b } else { low = a }
    }
    at(0.5 * (low + high)).max(heights[highest])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_top_of_a_sine_between_nodes() {
        let c = &*COLLOCATION;
        let sine = |x: f64| (2.0 * x + 0.3).sin();
        let lane = Lane(std::array::from_fn(|i| sine(if i < NODES { c.nodes[i] } else { 1.0 })));
        // Ninth derivative 2^9 over 9! times the node polynomial, at most 7.6e-6: 1.1e-8.
        assert!((interpolated_peak(sine(0.0), &lane) - 1.0).abs() < 1.1e-8);
    }
}
