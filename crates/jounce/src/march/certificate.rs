//! The proof that a flight step has no contact in it.
//!
//! Let `g(t)` be the distance past the stop (negative in flight) on a step of length `h`, split into a slow part, whose fourth
//! derivative is bounded by `M`, and a fast part bounded by `A`. The cubic Hermite interpolant `H` of the slow part satisfies
//! `|slow - H| <= M t^2 (h - t)^2 / 24`, hence
//!
//! ```text
//! g(t) <= H(t) + M t^2 (h - t)^2 / 24 + A,
//! ```
//!
//! a quartic. Its Bernstein coefficients on `[0, h]` are those of `H` raised to degree four, with `M h^4 / 144` added to the
//! middle one and `A` to all. A polynomial lies below its largest coefficient: if all are negative, there is no contact in
//! the step, grazing included. Blocks decay between contacts, so `M` and `A` at the start of the step hold throughout.

/// A step as the certificate sees it; distances past the stop in m, speeds in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightStep {
    /// Length, s.
    pub length_s: f64,
    /// Slow part at the start and at the end, m.
    pub distance_m: [f64; 2],
    /// Its speed at the start and at the end, m/s.
    pub speed_m_s: [f64; 2],
    /// `M`, m/s^4.
    pub fourth_bound: f64,
    /// `A`, m.
    pub fast_bound_m: f64,
}

impl FlightStep {
    /// Bernstein coefficients of the cubic Hermite interpolant raised to degree four.
    #[inline(always)]
    fn coefficients(&self) -> [f64; 5] {
        let [start, end] = self.distance_m;
        let third = self.length_s / 3.0;
        let (p1, p2) = (start + third * self.speed_m_s[0], end - third * self.speed_m_s[1]);
        [start, 0.25 * (start + 3.0 * p1), 0.5 * (p1 + p2), 0.25 * (3.0 * p2 + end), end]
    }

    /// Largest error of the Hermite interpolant plus the fast part, m.
    #[inline(always)]
    pub fn uncertainty_m(&self) -> f64 {
        self.fourth_bound * fourth_power(self.length_s) / 384.0 + self.fast_bound_m
    }

    /// Upper bound of the distance past the stop inside the step (its start left out), m: negative proves that there is no contact.
    #[inline(always)]
    pub fn highest_m(&self) -> f64 {
        let [q0, q1, q2, q3, q4] = self.coefficients();
        let bubble = self.fourth_bound * fourth_power(self.length_s) / 144.0;
        let inside = q1.max(q2 + bubble).max(q3.max(q4));
        // A flight may start on the stop itself (q0 = 0); with a fast part its start is as uncertain as the rest.
        if self.fast_bound_m > 0.0 { inside.max(q0) + self.fast_bound_m } else { inside }
    }

    /// First time in the step at which the Hermite interpolant passes zero upwards, s.
    pub fn crossing_s(&self) -> Option<f64> {
        let [start, end] = self.distance_m;
        let h = self.length_s;
        let (d0, d1) = (h * self.speed_m_s[0], h * self.speed_m_s[1]);
        let c2 = 3.0 * (end - start) - 2.0 * d0 - d1;
        let c3 = 2.0 * (start - end) + d0 + d1;
        let value = |x: f64| start + x * (d0 + x * (c2 + x * c3));
        // Between its turning points the cubic is monotone: look at each stretch in order.
        let mut stretch = 0.0;
        for stop in turning_points(d0, c2, c3).into_iter().chain([1.0]) {
            if value(stop) > 0.0 && value(stretch) <= 0.0 {
                return Some(h * bisect(value, stretch, stop));
            }
            stretch = stop;
        }
        None
    }
}

#[inline(always)]
fn fourth_power(x: f64) -> f64 {
    (x * x) * (x * x)
}

/// Zeros inside (0, 1) of `d0 + 2 c2 x + 3 c3 x^2`, ascending.
fn turning_points(d0: f64, c2: f64, c3: f64) -> Vec<f64> {
    let discriminant = c2 * c2 - 3.0 * c3 * d0;
    if discriminant <= 0.0 {
        return Vec::new();
    }
    let q = -(c2 + c2.signum() * discriminant.sqrt());
    let mut points: Vec<f64> = [q / (3.0 * c3), d0 / q].into_iter().filter(|x| *x > 0.0 && *x < 1.0).collect();
    points.sort_by(f64::total_cmp);
    points
}

/// Zero of a function that rises through zero between two places, to roundoff.
fn bisect(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (value(low), value(high));
    for _ in 0..60 {
        // False position with halving (Illinois) keeps the bracket and converges superlinearly.
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        let at_middle = value(middle);
        if at_middle == 0.0 || high - low <= 4.0 * f64::EPSILON * high {
            return middle;
        }
        if at_middle > 0.0 {
            (high, at_high) = (middle, at_middle);
            at_low *= 0.5;
        } else {
            (low, at_low) = (middle, at_middle);
            at_high *= 0.5;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slow part `a sin(w t + p) - gap`: the bound must hold on every step, however the sine lies in it.
    #[test]
    fn bound_is_above_the_function_and_tight_to_fourth_order() {
        for (w, h) in [(1.0, 0.5), (1.0, 2.0), (3.0, 0.9)] {
            for i in 0..200 {
                let phase = 0.03 * f64::from(i);
                let g = |t: f64| (w * t + phase).sin() - 0.9;
                let speed = |t: f64| w * (w * t + phase).cos();
                let step = FlightStep {
                    length_s: h,
                    distance_m: [g(0.0), g(h)],
                    speed_m_s: [speed(0.0), speed(h)],
                    fourth_bound: f64::powi(w, 4),
                    fast_bound_m: 0.0,
                };
                let highest = (1..=1000).map(|k| g(h * f64::from(k) / 1000.0)).fold(f64::MIN, f64::max);
                assert!(step.highest_m().max(g(0.0)) >= highest, "phase {phase}");
            }
        }
    }

    #[test]
    fn finds_the_first_of_two_crossings() {
        // (x - 0.2)(x - 0.6)(x - 1.5) rises through 0.2
        let value = |x: f64| (x - 0.2) * (x - 0.6) * (x - 1.5);
        let slope = |x: f64| (x - 0.6) * (x - 1.5) + (x - 0.2) * (x - 1.5) + (x - 0.2) * (x - 0.6);
        let step = FlightStep {
            length_s: 1.0,
            distance_m: [value(0.0), value(1.0)],
            speed_m_s: [slope(0.0), slope(1.0)],
            fourth_bound: 0.0,
            fast_bound_m: 0.0,
        };
        assert!((step.crossing_s().unwrap_or(0.0) - 0.2).abs() < 1e-14);
    }
}
