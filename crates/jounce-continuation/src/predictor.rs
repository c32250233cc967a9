//! Predictor: the cubic through both ends and both tangents of the last segment, extrapolated or
//! evaluated inside it.
//!
//! ```text
//! x(s) = x0 + h10 L t0 + h01 (x1 - x0) + h11 L t1,   h of s / L (Hermite),   s = 0 .. L on the segment, beyond it ahead
//! ```
//!
//! One step ahead its distance to the curve is of fourth order in `L`; that of the tangent is of
//! second order.

use super::{Direction, Metric, Position};

/// Two neighbouring points of a curve with their tangents.
#[derive(Debug, Clone, PartialEq)]
pub struct HermiteSegment {
    /// Start of the segment.
    start: Position,
    /// Vector from the start to the end.
    chord: Direction,
    /// Unit tangents times the length, at the two ends.
    tangents: [Direction; 2],
    /// Length `L`, in the metric.
    pub length: f64,
}

impl HermiteSegment {
    /// Creates the segment between two points with their tangents.
    pub fn between(
        metric: &Metric,
        (start, start_tangent): (&Position, &Direction),
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
            tangents: [scaled(start_tangent), scaled(beyond)],
            chord,
            length,
        }
    }

    /// Maps the segment to another unknown by a linear map.
    pub fn mapped(&self, map: &impl Fn(&[f64]) -> Vec<f64>) -> Self {
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

    /// Returns the point of the cubic at a distance from its start.
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

    /// Uses a circle, on which arc length equals angle.
    #[test]
    fn draws_a_circle_on_to_fourth_order() {
        let metric = Metric {
            unknown: 1.0,
            parameter: 1.0,
        };
        let on_circle = |angle: f64| Position {
            unknown: vec![angle.cos()],
            parameter: angle.sin(),
        };
        let tangent = |angle: f64| Direction {
            unknown: vec![-angle.sin()],
            parameter: angle.cos(),
        };
        let error = |step: f64| {
            let segment = HermiteSegment::between(
                &metric,
                (&on_circle(0.3), &tangent(0.3)),
                (&on_circle(0.3 + step), &tangent(0.3 + step)),
            );
            assert!(metric.length(&on_circle(0.3).to(&segment.at(0.0))) < 1e-15);
            assert!(metric.length(&on_circle(0.3 + step).to(&segment.at(segment.length))) < 1e-15);
            let predicted = segment.at(2.0 * segment.length);
            // Distance to the circle; the position along it does not matter.
            (predicted.unknown[0].hypot(predicted.parameter) - 1.0).abs()
        };
        let (coarse, fine) = (error(0.2), error(0.1));
        // L^4 / 6 from the remainder of the cubic, plus twice that because L is the chord and not
        // the arc.
        assert!(fine < 0.5e-4 && coarse / fine > 14.0, "{coarse:e} {fine:e}");
    }

    /// Doubles the unknown in two parts: evaluates after mapping, and maps after evaluation.
    #[test]
    fn mapped_segment_interpolates_mapped_points() {
        let metric = Metric {
            unknown: 1.0,
            parameter: 1.0,
        };
        let on_circle = |angle: f64| Position {
            unknown: vec![angle.cos(), 3.0 * angle],
            parameter: angle.sin(),
        };
        let tangent = |angle: f64| Direction {
            unknown: vec![-angle.sin(), 3.0],
            parameter: angle.cos(),
        };
        let segment = HermiteSegment::between(
            &metric,
            (&on_circle(0.3), &tangent(0.3)),
            (&on_circle(0.5), &tangent(0.5)),
        );
        let map = |unknown: &[f64]| vec![2.0 * unknown[0], 0.0, unknown[1] - unknown[0]];
        let (read, mapped) = (segment.at(0.7), segment.mapped(&map).at(0.7));
        assert!(
            metric.length(&mapped.to(&Position {
                unknown: map(&read.unknown),
                ..read
            })) < 1e-14
        );
    }
}
