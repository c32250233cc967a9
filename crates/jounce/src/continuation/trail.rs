//! The guess for the next place: the polynomial that has the last three places and their tangents, drawn on.
//!
//! ```text
//! x(s) = sum_i ((1 - 2 (s - s_i) l_i'(s_i)) x_i + (s - s_i) t_i) l_i(s)^2        (Hermite, l_i those of Lagrange)
//! ```
//!
//! `s` is the arclength by the chord and the turn of the tangent on it, `|x_1 - x_0| (1 + turn^2 / 24)`, as on a circle. With two
//! places it is a cubic, with one a line; one step ahead the guess misses the curve in the order of twice the number of places.

use super::{Direction, Metric, Position};

/// Places that are kept.
const MOST: usize = 3;

/// The last places of a walk with their tangents, oldest first.
#[derive(Debug, Clone, PartialEq)]
pub struct Trail {
    places: Vec<(Position, Direction)>,
}

impl Trail {
    /// With its first place.
    pub fn new(position: Position, tangent: Direction) -> Self {
        Self { places: vec![(position, tangent)] }
    }

    /// Adds a place.
    pub fn push(&mut self, position: Position, tangent: Direction) {
        if self.places.len() == MOST {
            self.places.remove(0);
        }
        self.places.push((position, tangent));
    }

    /// True with more than a line to draw on.
    pub fn bends(&self) -> bool {
        self.places.len() > 1
    }

    /// The place at a distance, in the metric, beyond the last one.
    pub fn ahead(&self, metric: &Metric, distance: f64) -> Position {
        let tangents: Vec<Direction> = self.places.iter().map(|(_, tangent)| metric.unit(tangent.clone())).collect();
        let mut at = vec![0.0];
        for (pair, turn) in self.places.windows(2).zip(tangents.windows(2)) {
            let angle = metric.inner(&turn[0], &turn[1]).clamp(-1.0, 1.0).acos();
            at.push(at[at.len() - 1] + metric.length(&pair[0].0.to(&pair[1].0)) * (1.0 + angle * angle / 24.0));
        }
        let s = at[at.len() - 1] + distance;
        let mut sum = Position { unknown: vec![0.0; self.places[0].0.unknown.len()], parameter: 0.0 };
        for (i, ((position, _), tangent)) in self.places.iter().zip(&tangents).enumerate() {
            let others = || at.iter().enumerate().filter(move |(j, _)| *j != i).map(|(_, other)| *other);
            let square = others().map(|other| (s - other) / (at[i] - other)).product::<f64>().powi(2);
            let slope: f64 = others().map(|other| 1.0 / (at[i] - other)).sum();
            let (own, along) = ((1.0 - 2.0 * (s - at[i]) * slope) * square, (s - at[i]) * square);
            let terms = position.unknown.iter().zip(&tangent.unknown);
            sum.unknown.iter_mut().zip(terms).for_each(|(sum, (x, t))| *sum += own * x + along * t);
            sum.parameter += own * position.parameter + along * tangent.parameter;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a circle, whose arc has the length of its angle.
    #[test]
    fn draws_a_circle_on_to_sixth_order() {
        let metric = Metric { unknown: 1.0, parameter: 1.0 };
        let place = |angle: f64| Position { unknown: vec![angle.cos()], parameter: angle.sin() };
        let tangent = |angle: f64| Direction { unknown: vec![-angle.sin()], parameter: angle.cos() };
        let error = |step: f64| {
            let mut trail = Trail::new(place(0.3 - 2.0 * step), tangent(0.3 - 2.0 * step));
            trail.push(place(0.3 - step), tangent(0.3 - step));
            trail.push(place(0.3), tangent(0.3));
            assert!(metric.length(&place(0.3).to(&trail.ahead(&metric, 0.0))) < 1e-15);
            let ahead = trail.ahead(&metric, step);
            (ahead.unknown[0].hypot(ahead.parameter) - 1.0).abs()
        };
        let (coarse, fine) = (error(0.2), error(0.1));
        // (3! step^3)^2 / 6! = step^6 / 20 by the remainder of the polynomial.
        assert!(fine < 1e-7 && coarse / fine > 40.0, "{coarse:e} {fine:e}");
    }
}
