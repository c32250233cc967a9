//! The guess: the cubic that has both places and both tangents of the last stretch, drawn on, or read inside it.
//!
//! ```text
//! x(s) = x0 + h10 L t0 + h01 (x1 - x0) + h11 L t1,   h of s / L (Hermite),   s = 0 .. L on the stretch, beyond it ahead
//! ```
//!
//! One step ahead its distance to the curve is of the fourth order in `L`, where the tangent alone leaves the second order.

use super::{Direction, Metric, Position};

/// Two neighbouring places of a curve with their tangents.
#[derive(Debug, Clone, PartialEq)]
pub struct HermiteSegment {
    /// Where it starts.
    start: Position,
    /// From there to its end.
    chord: Direction,
    /// Unit tangents times the length, at its two ends.
    tangents: [Direction; 2],
    /// Its length `L`, in the metric.
    pub length: f64,
}

impl HermiteSegment {
    /// Between two places with their tangents.
    pub fn between(
        metric: &Metric,
        (start, ahead): (&Position, &Direction),
        (end, beyond): (&Position, &Direction),
    ) -> Self {
        let chord = start.to(end);
        let length = metric.length(&chord);
        let scaled = |direction: &Direction| {
            let unit = metric.unit(direction.clone());
            Direction {
                unknown: unit.unknown.iter().map(|d| d * length).collect(),
                parameter: unit.parameter * length,
            }
        };
        Self {
            start: start.clone(),
            tangents: [scaled(ahead), scaled(beyond)],
            chord,
            length,
        }
    }

    /// The same in another unknown, by the linear map that leads there.
    pub fn carried(&self, map: &impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let direction = |from: &Direction| Direction {
            unknown: map(&from.unknown),
            parameter: from.parameter,
        };
        let start = Position {
            unknown: map(&self.start.unknown),
            parameter: self.start.parameter,
        };
        let [first, last] = &self.tangents;
        Self {
            start,
            chord: direction(&self.chord),
            tangents: [direction(first), direction(last)],
            length: self.length,
        }
    }

    /// The cubic at a distance from its start.
    pub fn at(&self, distance: f64) -> Position {
        let t = distance / self.length;
        let along = t * t * (3.0 - 2.0 * t);
        let [first, last] = [t * (t - 1.0) * (t - 1.0), t * t * (t - 1.0)];
        let value =
            |x0: f64, chord: f64, t0: f64, t1: f64| x0 + along * chord + first * t0 + last * t1;
        let [from, to] = &self.tangents;
        let unknown = (0..self.start.unknown.len())
            .map(|i| {
                value(
                    self.start.unknown[i],
                    self.chord.unknown[i],
                    from.unknown[i],
                    to.unknown[i],
                )
            })
            .collect();
        Position {
            unknown,
            parameter: value(
                self.start.parameter,
                self.chord.parameter,
                from.parameter,
                to.parameter,
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On a circle, whose arc has the length of its angle.
    #[test]
    fn draws_a_circle_on_to_fourth_order() {
        let metric = Metric {
            unknown: 1.0,
            parameter: 1.0,
        };
        let place = |angle: f64| Position {
            unknown: vec![angle.cos()],
            parameter: angle.sin(),
        };
        let tangent = |angle: f64| Direction {
            unknown: vec![-angle.sin()],
            parameter: angle.cos(),
        };
        let error = |step: f64| {
            let stretch = HermiteSegment::between(
                &metric,
                (&place(0.3), &tangent(0.3)),
                (&place(0.3 + step), &tangent(0.3 + step)),
            );
            assert!(metric.length(&place(0.3).to(&stretch.at(0.0))) < 1e-15);
            assert!(metric.length(&place(0.3 + step).to(&stretch.at(stretch.length))) < 1e-15);
            let ahead = stretch.at(2.0 * stretch.length);
            // Distance to the circle: how far along it the guess lies is of no account.
            (ahead.unknown[0].hypot(ahead.parameter) - 1.0).abs()
        };
        let (coarse, fine) = (error(0.2), error(0.1));
        // L^4 / 6 by the remainder of the cubic, and as much again twice because L is the chord and not the arc.
        assert!(fine < 0.5e-4 && coarse / fine > 14.0, "{coarse:e} {fine:e}");
    }

    /// Twice the unknown in two parts: read after it was carried, and carried after it was read.
    #[test]
    fn a_carried_stretch_reads_as_its_carried_places() {
        let metric = Metric {
            unknown: 1.0,
            parameter: 1.0,
        };
        let place = |angle: f64| Position {
            unknown: vec![angle.cos(), 3.0 * angle],
            parameter: angle.sin(),
        };
        let tangent = |angle: f64| Direction {
            unknown: vec![-angle.sin(), 3.0],
            parameter: angle.cos(),
        };
        let stretch = HermiteSegment::between(
            &metric,
            (&place(0.3), &tangent(0.3)),
            (&place(0.5), &tangent(0.5)),
        );
        let map = |unknown: &[f64]| vec![2.0 * unknown[0], 0.0, unknown[1] - unknown[0]];
        let (read, carried) = (stretch.at(0.7), stretch.carried(&map).at(0.7));
        assert!(
            metric.length(&carried.to(&Position {
                unknown: map(&read.unknown),
                ..read
            })) < 1e-14
        );
    }
}
