//! Bracket of a zero of a function, reduced by safeguarded inverse quadratic interpolation.
//!
//! Source: T. R. Chandrupatla, Adv. Eng. Software 28 (1997) 145.

/// Two points with values of opposite sign.
#[derive(Debug, Clone, Copy)]
pub struct Bracket {
    /// Last point.
    last: (f64, f64),
    /// Point on the other side of the zero.
    other: (f64, f64),
    /// Point replaced last, the third point of the interpolation.
    replaced: Option<(f64, f64)>,
}

impl Bracket {
    /// Bracket between two points whose values differ in sign.
    pub fn between(low: (f64, f64), high: (f64, f64)) -> Self {
        Self {
            last: high,
            other: low,
            replaced: None,
        }
    }

    /// Length of the bracket.
    pub fn length(&self) -> f64 {
        (self.last.0 - self.other.0).abs()
    }

    /// Next trial point, at least half a resolution from either side.
    pub fn next(&self, resolution: f64) -> f64 {
        let least = (0.5 * resolution / self.length()).min(0.5);
        let share = self.share().clamp(least, 1.0 - least);
        self.last.0 + share * (self.other.0 - self.last.0)
    }

    /// Inserts a point with its value; returns the length of the move to it.
    pub fn put(&mut self, position: f64, value: f64) -> f64 {
        let step = (position - self.last.0).abs();
        if (value > 0.0) == (self.last.1 > 0.0) {
            self.replaced = Some(self.last);
        } else {
            self.replaced = Some(self.other);
            self.other = self.last;
        }
        self.last = (position, value);
        step
    }

    /// Fraction of the distance from the last point to the other.
    fn share(&self) -> f64 {
        let ((x1, f1), (x2, f2)) = (self.last, self.other);
        let Some((x3, f3)) = self.replaced else {
            return f1 / (f1 - f2);
        };
        let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
        let is_smooth = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        if is_smooth {
            f1 / (f2 - f1) * f3 / (f2 - f3)
                + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        } else {
            0.5
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solves `x^3 = 2` between 0 and 4, and a function that is flat about its zero, `(x - 1)^9`.
    #[test]
    fn closes_in_on_a_zero() {
        let sought = |value: &dyn Fn(f64) -> f64, evaluations: u32| {
            let mut bracket = Bracket::between((0.0, value(0.0)), (4.0, value(4.0)));
            (0..evaluations).for_each(|_| {
                let x = bracket.next(1e-15);
                bracket.put(x, value(x));
            });
            bracket.last.0
        };
        let root = sought(&|x| x * x * x - 2.0, 10);
        assert!((root - 2.0_f64.cbrt()).abs() < 1e-12, "{root}");
        let flat = sought(&|x: f64| (x - 1.0).powi(9), 60);
        assert!((flat - 1.0).abs() < 1e-6, "{flat}");
    }
}
