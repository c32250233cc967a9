//! The proof that a flight step has no contact in it, or exactly one crossing.
//!
//! Let `g(t)` be the distance past the stop (negative in flight) on a step of length `h`, split into a slow part, whose fourth
//! derivative is bounded by `M`, and a fast part `f` bounded by `A` with its rate bounded by `B`. The cubic Hermite interpolant
//! `H` of the slow part satisfies `|slow - H| <= M t^2 (h - t)^2 / 24`, hence both
//!
//! ```text
//! g(t) <= H(t) + M t^2 (h - t)^2 / 24 + A,
//! g(t) <= H(t) + M t^2 (h - t)^2 / 24 + f(0) + B t,
//! ```
//!
//! two quartics. The Bernstein coefficients of each on `[0, h]` are those of `H` raised to degree four, with `M h^4 / 144` added
//! to the middle one, and the constant or the line added to all. A polynomial lies below its largest coefficient: if all of one
//! quartic are negative, there is no contact in the step, grazing included. Blocks decay between contacts, so `M`, `A` and `B`
//! at the start of the step hold throughout.
//!
//! A crossing is proved the first and only one when, around the zero of `H`, there is an interval before which a quartic is
//! negative, at whose end `g` is positive, and in which `g` rises: there `|slow' - H'| <= sqrt(3) M h^3 / 216`, and `H'` is a
//! parabola whose Bernstein coefficients bound it from below.

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
    /// `f(0)`, m.
    pub fast_m: f64,
    /// `A`, m.
    pub fast_bound_m: f64,
    /// `B`, m/s.
    pub fast_bound_m_s: f64,
}

/// An interval that holds the first crossing of a step and no other, s after its start; `guess_s` is the zero of `H`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// No contact before.
    pub from_s: f64,
    /// Near the crossing.
    pub guess_s: f64,
    /// Past the stop here.
    pub to_s: f64,
}

/// To what share of the step the zero of `H` is found; the margin of a crossing is ten times as wide.
const LOCATED: f64 = 1e-10;

impl FlightStep {
    /// Bernstein coefficients of the cubic Hermite interpolant.
    #[inline(always)]
    fn cubic(&self) -> [f64; 4] {
        let [start, end] = self.distance_m;
        let third = self.length_s / 3.0;
        [start, start + third * self.speed_m_s[0], end - third * self.speed_m_s[1], end]
    }

    /// Both quartics.
    #[inline(always)]
    fn bounds(&self) -> [[f64; 5]; 2] {
        let [p0, p1, p2, p3] = self.cubic();
        let bubble = self.fourth_bound * fourth_power(self.length_s) / 144.0;
        let shared = [p0, 0.25 * (p0 + 3.0 * p1), 0.5 * (p1 + p2) + bubble, 0.25 * (3.0 * p2 + p3), p3];
        let quarter = 0.25 * self.fast_bound_m_s * self.length_s;
        let (mut flat, mut sloped) = (shared, shared);
        for i in 0..5 {
            flat[i] += self.fast_bound_m;
            sloped[i] += self.fast_m + quarter * i as f64;
        }
        [flat, sloped]
    }

    /// True when the step is proved free of contact. It starts in flight or on the stop.
    #[inline(always)]
    pub fn is_clear(&self) -> bool {
        let [flat, sloped] = self.bounds();
        is_negative(flat, sloped)
    }

    /// What is not known about the distance inside the step, m.
    #[inline(always)]
    pub fn uncertainty_m(&self) -> f64 {
        let fast = (2.0 * self.fast_bound_m).min(self.fast_bound_m_s * self.length_s);
        self.fourth_bound * fourth_power(self.length_s) / 384.0 + fast
    }

    /// What is not known about its rate, m/s.
    #[inline(always)]
    pub fn rate_uncertainty_m_s(&self) -> f64 {
        let cube = self.length_s * self.length_s * self.length_s;
        3.0_f64.sqrt() / 216.0 * self.fourth_bound * cube + self.fast_bound_m_s
    }

    /// The first crossing, when it can be proved to be one.
    #[inline(always)]
    pub fn crossing(&self) -> Option<Crossing> {
        let guess_s = self.crossing_s()?;
        let h = self.length_s;
        let rate = self.rate_uncertainty_m_s();
        let slope = self.slope(guess_s / h);
        if slope <= rate {
            return None;
        }
        let half_s = 1.5 * self.uncertainty_m() / (slope - rate) + 10.0 * LOCATED * h;
        let (from_s, to_s) = ((guess_s - half_s).max(0.0), (guess_s + half_s).min(h));
        let rises = {
            // The parabola H' on [from, to] lies above the least of its Bernstein coefficients.
            let (a, b) = (self.slope(from_s / h), self.slope(to_s / h));
            let middle = 2.0 * self.slope(0.5 * (from_s + to_s) / h) - 0.5 * (a + b);
            a.min(b).min(middle) > rate
        };
        let clear_before = from_s == 0.0 || {
            let [flat, sloped] = self.bounds().map(|bound| left_of(bound, from_s / h));
            is_negative(flat, sloped)
        };
        let past = if to_s == h { self.distance_m[1] + self.fast_m } else { self.value(to_s / h) + self.fast_m } > self.uncertainty_m();
        (rises && clear_before && past).then_some(Crossing { from_s, guess_s, to_s })
    }

    /// First time in the step at which the interpolant, shifted to start where `g` starts, passes zero upwards, s.
    #[inline(always)]
    pub fn crossing_s(&self) -> Option<f64> {
        let [p0, p1, p2, p3] = self.cubic().map(|p| p + self.fast_m);
        // Between its turning points the cubic is monotone: look at each stretch in order.
        let mut stretch = (0.0, p0.min(0.0));
        for x in self.turning_points().into_iter().flatten().chain([1.0]) {
            let at = bezier([p0, p1, p2, p3], x);
            if at > 0.0 && stretch.1 <= 0.0 {
                return Some(self.length_s * self.zero_between(stretch.0, x));
            }
            stretch = (x, at);
        }
        None
    }

    /// Zero of the shifted interpolant in a stretch where it rises through zero, by Newton kept inside the bracket.
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
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            let done = (next - x).abs() <= LOCATED;
            x = next;
            if done {
                break;
            }
        }
        x
    }

    /// Zeros of `H'` inside the step, ascending, as shares of it.
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
        if matches!((x, y), (Some(x), Some(y)) if x > y) { [y, x] } else { [x, y] }
    }

    #[inline(always)]
    fn value(&self, x: f64) -> f64 {
        bezier(self.cubic(), x)
    }

    /// `H'` at a share of the step, m/s.
    #[inline(always)]
    fn slope(&self, x: f64) -> f64 {
        let [p0, p1, p2, p3] = self.cubic();
        let y = 1.0 - x;
        3.0 / self.length_s * ((p1 - p0) * y * y + 2.0 * (p2 - p1) * x * y + (p3 - p2) * x * x)
    }
}

#[inline(always)]
fn fourth_power(x: f64) -> f64 {
    (x * x) * (x * x)
}

#[inline(always)]
fn bezier([p0, p1, p2, p3]: [f64; 4], x: f64) -> f64 {
    let y = 1.0 - x;
    ((p0 * y + 3.0 * p1 * x) * y + 3.0 * p2 * x * x) * y + p3 * x * x * x
}

/// The flat quartic is negative, or the sloped one after its start, which lies in flight or on the stop.
#[inline(always)]
fn is_negative(flat: [f64; 5], sloped: [f64; 5]) -> bool {
    flat.iter().all(|q| *q < 0.0) || sloped[1..].iter().all(|q| *q < 0.0)
}

/// Bernstein coefficients on `[0, x]` of a quartic given on `[0, 1]`, by de Casteljau.
#[inline(always)]
fn left_of(mut row: [f64; 5], x: f64) -> [f64; 5] {
    let mut left = [row[0]; 5];
    for (level, out) in left.iter_mut().enumerate().skip(1) {
        for i in 0..5 - level {
            row[i] += x * (row[i + 1] - row[i]);
        }
        *out = row[0];
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slow part `a sin(w t + p)`, fast part `b sin(v t)`, gap 0.9.
    struct Motion {
        w: f64,
        phase: f64,
        b: f64,
        v: f64,
    }

    impl Motion {
        fn slow(&self, t: f64) -> f64 {
            (self.w * t + self.phase).sin() - 0.9
        }

        fn at(&self, t: f64) -> f64 {
            self.slow(t) + self.b * (self.v * t).sin()
        }

        fn step(&self, h: f64) -> FlightStep {
            let speed = |t: f64| self.w * (self.w * t + self.phase).cos();
            FlightStep {
                length_s: h,
                distance_m: [self.slow(0.0), self.slow(h)],
                speed_m_s: [speed(0.0), speed(h)],
                fourth_bound: self.w.powi(4),
                fast_m: 0.0,
                fast_bound_m: self.b,
                fast_bound_m_s: self.b * self.v,
            }
        }
    }

    fn motions() -> impl Iterator<Item = (Motion, f64)> {
        [(1.0, 0.5), (1.0, 2.0), (3.0, 0.9), (1.0, 0.05)].into_iter().flat_map(|(w, h)| {
            (0..300).flat_map(move |i| [0.0, 1e-3, 0.05].map(|b| (Motion { w, phase: 0.021 * f64::from(i), b, v: 40.0 }, h)))
        })
    }

    #[test]
    fn a_clear_step_has_no_contact_and_some_steps_are_clear() {
        let mut clear = 0;
        for (motion, h) in motions() {
            if motion.at(0.0) <= 0.0 && motion.step(h).is_clear() {
                clear += 1;
                let highest = (1..=2000).map(|k| motion.at(h * f64::from(k) / 2000.0)).fold(f64::MIN, f64::max);
                assert!(highest < 0.0, "w {} phase {} b {} h {h}: {highest}", motion.w, motion.phase, motion.b);
            }
        }
        assert!(clear > 1000, "{clear} clear steps");
    }

    #[test]
    fn a_proved_crossing_is_the_first_and_only_one_of_its_interval() {
        let mut proved = 0;
        for (motion, h) in motions() {
            let step = motion.step(h);
            let Some(crossing) = step.crossing().filter(|_| motion.at(0.0) <= 0.0) else { continue };
            proved += 1;
            let place = |k: u32, from: f64, to: f64| from + (to - from) * f64::from(k) / 1000.0;
            assert!((1..=1000).all(|k| motion.at(place(k, 0.0, crossing.from_s)) < 1e-15), "contact before {crossing:?}");
            assert!(motion.at(crossing.to_s) > 0.0, "not past the stop after {crossing:?}");
            let values: Vec<f64> = (0..=1000).map(|k| motion.at(place(k, crossing.from_s, crossing.to_s))).collect();
            assert!(values.windows(2).all(|pair| pair[1] > pair[0] - 1e-15), "falls inside {crossing:?}");
        }
        assert!(proved > 100, "{proved} proved crossings");
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
            fast_m: 0.0,
            fast_bound_m: 0.0,
            fast_bound_m_s: 0.0,
        };
        assert!((step.crossing_s().unwrap_or(0.0) - 0.2).abs() < 1e-14);
    }
}
