//! Proof that the first crossing of a flight step has been found.
//!
//! With `H`, `M`, `h` and the quartics of [`super::certificate`], an interval around the zero of
//! `H` holds the first and only crossing under three conditions. A quartic is negative before the
//! interval, `g` is positive at its end, and `g` rises inside it. There
//! `|slow' - H'| <= sqrt(3) M h^3 / 216`, and `H'` is a parabola whose Bernstein coefficients bound
//! it from below.

use super::certificate::{FlightStep, is_negative};

/// Interval that holds the first and only crossing of a step, s after its start; `guess_s` is the
/// zero of `H`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// No contact occurs before.
    pub from_s: f64,
    /// Estimate of the crossing.
    pub guess_s: f64,
    /// The point is past the stop here.
    pub to_s: f64,
}

/// Relative accuracy of the zero of `H`; the margin of a crossing is ten times as wide.
const CROSSING_TOLERANCE: f64 = 1e-10;

impl FlightStep {
    /// Returns the first crossing, if it can be proved.
    #[inline(always)]
    pub fn crossing(&self) -> Option<Crossing> {
        let guess_s = self.crossing_s()?;
        let h = self.length_s;
        let rate = self.rate_uncertainty_m_s();
        let slope = self.slope(guess_s / h);
        if slope <= rate {
            return None;
        }
        let half_s =
            1.5 * self.uncertainty_m() / (slope - rate) + 10.0 * CROSSING_TOLERANCE * guess_s;
        let (from_s, to_s) = ((guess_s - half_s).max(0.0), (guess_s + half_s).min(h));
        let rises = {
            // The parabola H' on [from, to] is bounded below by its smallest Bernstein coefficient.
            let (a, b) = (self.slope(from_s / h), self.slope(to_s / h));
            let middle = 2.0 * self.slope(0.5 * (from_s + to_s) / h) - 0.5 * (a + b);
            a.min(b).min(middle) > rate
        };
        let clear_before = from_s == 0.0 || {
            let [flat, sloped] = self.bounds().map(|bound| left_half(bound, from_s / h));
            is_negative(flat, sloped)
        };
        let past = if to_s == h {
            self.distance_m[1] + self.fast_m
        } else {
            self.value(to_s / h) + self.fast_m
        } > self.uncertainty_m();
        (rises && clear_before && past).then_some(Crossing {
            from_s,
            guess_s,
            to_s,
        })
    }

    /// Returns the first time in the step at which the interpolant, shifted to start where `g`
    /// starts, passes zero upwards, s.
    #[inline(always)]
    pub fn crossing_s(&self) -> Option<f64> {
        let [p0, p1, p2, p3] = self.cubic().map(|p| p + self.fast_m);
        // Between its turning points the cubic is monotone: search each interval in order. A point
        // past its stop by roundoff impacts at once if it moves in. If it moves out, it impacts
        // after it has left, or where it turns back before that.
        let mut interval = (0.0, if p1 < p0 { p0 } else { p0.min(0.0) });
        for x in self.turning_points().into_iter().flatten().chain([1.0]) {
            let at = bezier([p0, p1, p2, p3], x);
            if at > 0.0 && interval.1 <= 0.0 {
                return Some(self.length_s * self.zero_between(interval.0, x));
            }
            if at > interval.1 && interval.1 > 0.0 {
                return Some(self.length_s * interval.0);
            }
            interval = (x, at);
        }
        None
    }

    /// Returns the highest value of the shifted interpolant, m.
    pub fn highest_m(&self) -> f64 {
        let shifted = self.cubic().map(|p| p + self.fast_m);
        let inside = self
            .turning_points()
            .into_iter()
            .flatten()
            .map(|x| bezier(shifted, x));
        inside.fold(shifted[0].max(shifted[3]), f64::max)
    }

    /// Returns the zero of the shifted interpolant in an interval where it rises through zero, by
    /// Newton confined to the bracket.
    #[inline(always)]
    fn zero_between(&self, mut low: f64, mut high: f64) -> f64 {
        let shifted = self.cubic().map(|p| p + self.fast_m);
        let mut x = 0.5 * (low + high);
        for _ in 0..60 {
            let at = bezier(shifted, x);
            if at > 0.0 {
                high = x
            } else {
                low = x
            }
            let newton = x - at / (self.length_s * self.slope(x));
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let done = (next - x).abs() <= CROSSING_TOLERANCE * next;
            x = next;
            if done {
                break;
            }
        }
        x
    }

    /// Returns the zeros of `H'` inside the step, ascending, as fractions of it.
    #[inline(always)]
    fn turning_points(&self) -> [Option<f64>; 2] {
        let [p0, p1, p2, p3] = self.cubic();
        // H' / 3 = a + 2 b x + c x^2
        let (a, b, c) = (p1 - p0, p2 - 2.0 * p1 + p0, p3 - 3.0 * p2 + 3.0 * p1 - p0);
        let discriminant = b * b - a * c;
        if discriminant <= 0.0 {
            return [None, None];
        }
        let q = -(b + b.signum() * discriminant.sqrt());
        let inside = |x: f64| (x > 0.0 && x < 1.0).then_some(x);
        let (x, y) = (inside(q / c), inside(a / q));
        if matches!((x, y), (Some(x), Some(y)) if x > y) {
            [y, x]
        } else {
            [x, y]
        }
    }

    #[inline(always)]
    fn value(&self, x: f64) -> f64 {
        bezier(self.cubic(), x)
    }

    /// Returns `H'` at a fraction of the step, m/s.
    #[inline(always)]
    fn slope(&self, x: f64) -> f64 {
        let [p0, p1, p2, p3] = self.cubic();
        let y = 1.0 - x;
        3.0 / self.length_s * ((p1 - p0) * y * y + 2.0 * (p2 - p1) * x * y + (p3 - p2) * x * x)
    }
}

#[inline(always)]
fn bezier([p0, p1, p2, p3]: [f64; 4], x: f64) -> f64 {
    let y = 1.0 - x;
    ((p0 * y + 3.0 * p1 * x) * y + 3.0 * p2 * x * x) * y + p3 * x * x * x
}

/// Returns the Bernstein coefficients on `[0, x]` of a quartic given on `[0, 1]`, by de Casteljau.
#[inline(always)]
fn left_half(mut row: [f64; 5], x: f64) -> [f64; 5] {
    let mut left = [row[0]; 5];
    for (level, out) in left.iter_mut().enumerate().skip(1) {
        for i in 0..5 - level {
            row[i] += x * (row[i + 1] - row[i]);
        }
        *out = row[0];
    }
    left
}
