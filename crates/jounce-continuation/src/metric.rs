//! Metric for lengths along a curve.
//!
//! ```text
//! |(du, dp)|^2 = |du|^2 / U^2 + dp^2 / P^2
//! ```
//!
//! `U` is the norm of the unknown at the current point, so a step is a relative change of the
//! solution, equally at a peak and on the flank. `P` is a fixed fraction of the range of the
//! parameter.

/// Point of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Position {
    /// `u`.
    pub unknown: Vec<f64>,
    /// `p`.
    pub parameter: f64,
}

/// Direction in `(u, p)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// `du`.
    pub unknown: Vec<f64>,
    /// `dp`.
    pub parameter: f64,
}

/// Scales of the unknown and of the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metric {
    /// `U`.
    pub unknown: f64,
    /// `P`.
    pub parameter: f64,
}

impl Metric {
    /// Returns the metric at a position.
    pub fn at(position: &Position, parameter: f64) -> Self {
        let size = position.unknown.iter().map(|u| u * u).sum::<f64>().sqrt();
        Self {
            unknown: if size > 0.0 { size } else { 1.0 },
            parameter,
        }
    }

    /// Returns the inner product.
    pub fn inner(&self, a: &Direction, b: &Direction) -> f64 {
        let unknown: f64 = a.unknown.iter().zip(&b.unknown).map(|(a, b)| a * b).sum();
        unknown / (self.unknown * self.unknown)
            + a.parameter * b.parameter / (self.parameter * self.parameter)
    }

    /// Returns the length.
    pub fn length(&self, direction: &Direction) -> f64 {
        self.inner(direction, direction).sqrt()
    }

    /// Returns the row `<direction, .>`: entries for the unknowns, and for the parameter.
    pub fn row(&self, direction: &Direction) -> (Vec<f64>, f64) {
        let square = self.unknown * self.unknown;
        (
            direction.unknown.iter().map(|d| d / square).collect(),
            direction.parameter / (self.parameter * self.parameter),
        )
    }

    /// Scales a direction to length one.
    pub fn unit(&self, mut direction: Direction) -> Direction {
        let length = self.length(&direction);
        direction.unknown.iter_mut().for_each(|d| *d /= length);
        direction.parameter /= length;
        direction
    }
}

impl Position {
    /// Returns the vector to another position.
    pub fn to(&self, other: &Position) -> Direction {
        let unknown = self
            .unknown
            .iter()
            .zip(&other.unknown)
            .map(|(a, b)| b - a)
            .collect();
        Direction {
            unknown,
            parameter: other.parameter - self.parameter,
        }
    }

    /// Returns the position a given length along a direction.
    pub fn offset_along(&self, direction: &Direction, length: f64) -> Self {
        let unknown = self
            .unknown
            .iter()
            .zip(&direction.unknown)
            .map(|(u, d)| u + length * d)
            .collect();
        Self {
            unknown,
            parameter: self.parameter + length * direction.parameter,
        }
    }
}
