//! Proof that a flight step is free of contact.
//!
//! Let `g(t)` be the distance past the stop (negative in flight) on a step of length `h`. It is
//! split into a slow part, whose fourth derivative is bounded by `M`, and a fast part `f`, bounded
//! by `A` with its rate bounded by `B`. The cubic Hermite interpolant `H` of the slow part
//! satisfies `|slow - H| <= M t^2 (h - t)^2 / 24`, hence both
//!
//! ```text
//! g(t) <= H(t) + M t^2 (h - t)^2 / 24 + A,
//! g(t) <= H(t) + M t^2 (h - t)^2 / 24 + f(0) + B t,
//! ```
//!
//! two quartics. The Bernstein coefficients of each on `[0, h]` are the coefficients of `H` raised
//! to degree four. `M h^4 / 144` is added to the middle one, and the constant or the line to all. A
//! polynomial is bounded by its largest coefficient: if all of one quartic are negative, there is
//! no contact in the step, grazing included. Blocks decay between contacts, so `M`, `A` and `B` at
//! the start of the step bound the complete step.

/// Data of a step for the certificate; distances past the stop in m, speeds in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlightStep {
    /// Length, s.
    pub length_s: f64,
    /// Slow part at the start and at the end, m.
    pub distance_m: [f64; 2],
    /// Speed of the slow part at the start and at the end, m/s.
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

impl FlightStep {
    /// Returns the Bernstein coefficients of the cubic Hermite interpolant.
    #[inline(always)]
    pub(crate) fn cubic(&self) -> [f64; 4] {
        let [start, end] = self.distance_m;
        let third = self.length_s / 3.0;
        [
            start,
            start + third * self.speed_m_s[0],
            end - third * self.speed_m_s[1],
            end,
        ]
    }

    /// Returns both quartics.
    #[inline(always)]
    pub(crate) fn bounds(&self) -> [[f64; 5]; 2] {
        let [p0, p1, p2, p3] = self.cubic();
        let bubble = self.fourth_bound * fourth_power(self.length_s) / 144.0;
        let shared = [
            p0,
            0.25 * (p0 + 3.0 * p1),
            0.5 * (p1 + p2) + bubble,
            0.25 * (3.0 * p2 + p3),
            p3,
        ];
        let quarter = 0.25 * self.fast_bound_m_s * self.length_s;
        let (mut flat, mut sloped) = (shared, shared);
        for i in 0..5 {
            flat[i] += self.fast_bound_m;
            sloped[i] += self.fast_m + quarter * i as f64;
        }
        [flat, sloped]
    }

    /// True when the step is proved free of contact. The step starts in flight or on the stop.
    #[inline(always)]
    pub fn is_clear(&self) -> bool {
        let [flat, sloped] = self.bounds();
        is_negative(flat, sloped)
    }

    /// Returns the uncertainty of the distance inside the step, m.
    #[inline(always)]
    pub fn uncertainty_m(&self) -> f64 {
        let fast = (2.0 * self.fast_bound_m).min(self.fast_bound_m_s * self.length_s);
        self.fourth_bound * fourth_power(self.length_s) / 384.0 + fast
    }

    /// Returns the uncertainty of the rate of the distance, m/s.
    #[inline(always)]
    pub fn rate_uncertainty_m_s(&self) -> f64 {
        let cube = self.length_s * self.length_s * self.length_s;
        3.0_f64.sqrt() / 216.0 * self.fourth_bound * cube + self.fast_bound_m_s
    }
}

#[inline(always)]
fn fourth_power(x: f64) -> f64 {
    (x * x) * (x * x)
}

/// True where the flat quartic is negative, or the sloped one after its start, which is in flight
/// or on the stop. A point that leaves its stop from rest has two coefficients of zero there.
#[inline(always)]
pub(super) fn is_negative(flat: [f64; 5], sloped: [f64; 5]) -> bool {
    flat.iter().all(|q| *q < 0.0) || (sloped[1..].iter().all(|q| *q <= 0.0) && sloped[4] < 0.0)
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
        [(1.0, 0.5), (1.0, 2.0), (3.0, 0.9), (1.0, 0.05)]
            .into_iter()
            .flat_map(|(w, h)| {
                (0..300).flat_map(move |i| {
                    [0.0, 1e-3, 0.05].map(|b| {
                        (
                            Motion {
                                w,
                                phase: 0.021 * f64::from(i),
                                b,
                                v: 40.0,
                            },
                            h,
                        )
                    })
                })
            })
    }

    #[test]
    fn a_clear_step_has_no_contact_and_some_steps_are_clear() {
        let mut clear = 0;
        for (motion, h) in motions() {
            if motion.at(0.0) <= 0.0 && motion.step(h).is_clear() {
                clear += 1;
                let highest = (1..=2000)
                    .map(|k| motion.at(h * f64::from(k) / 2000.0))
                    .fold(f64::MIN, f64::max);
                assert!(
                    highest < 0.0,
                    "w {} phase {} b {} h {h}: {highest}",
                    motion.w,
                    motion.phase,
                    motion.b
                );
            }
        }
        assert!(clear > 1000, "{clear} clear steps");
    }

    #[test]
    fn a_proved_crossing_is_the_first_and_only_one_of_its_interval() {
        let mut proved = 0;
        for (motion, h) in motions() {
            let step = motion.step(h);
            let Some(crossing) = step.crossing().filter(|_| motion.at(0.0) <= 0.0) else {
                continue;
            };
            proved += 1;
            let position = |k: u32, from: f64, to: f64| from + (to - from) * f64::from(k) / 1000.0;
            assert!(
                (1..=1000).all(|k| motion.at(position(k, 0.0, crossing.from_s)) < 1e-15),
                "contact before {crossing:?}"
            );
            assert!(
                motion.at(crossing.to_s) > 0.0,
                "not past the stop after {crossing:?}"
            );
            let values: Vec<f64> = (0..=1000)
                .map(|k| motion.at(position(k, crossing.from_s, crossing.to_s)))
                .collect();
            assert!(
                values.windows(2).all(|pair| pair[1] > pair[0] - 1e-15),
                "falls inside {crossing:?}"
            );
        }
        assert!(proved > 100, "{proved} proved crossings");
    }

    #[test]
    fn a_point_that_leaves_its_stop_from_rest_is_clear() {
        let leaves = Motion {
            w: 1.0,
            phase: 0.5 * std::f64::consts::PI,
            b: 0.0,
            v: 1.0,
        };
        let mut step = leaves.step(0.5);
        step.distance_m = [0.0, step.distance_m[1] - step.distance_m[0]];
        step.speed_m_s[0] = 0.0;
        assert!(step.is_clear());
        step.distance_m[1] = 0.0;
        step.speed_m_s[1] = 0.0;
        assert!(!step.is_clear(), "a point that stays is not clear");
    }

    /// `g = 2.6e-21 - 1e-10 t + t^2` has its minimum, above zero, at `t = 5e-11`.
    #[test]
    fn a_point_that_turns_back_before_it_leaves_its_stop_impacts() {
        let (past_m, out_m_s) = (2.6e-21, 1e-10);
        let mut step = FlightStep {
            length_s: 1.0,
            distance_m: [past_m, past_m - out_m_s + 1.0],
            speed_m_s: [-out_m_s, 2.0 - out_m_s],
            fourth_bound: 0.0,
            fast_m: 0.0,
            fast_bound_m: 0.0,
            fast_bound_m_s: 0.0,
        };
        let turns_s = step.crossing_s().unwrap_or(1.0);
        assert!((turns_s / 5e-11 - 1.0).abs() < 1e-3, "{turns_s}");
        step.distance_m[1] = past_m - out_m_s;
        step.speed_m_s[1] = -out_m_s;
        assert_eq!(
            step.crossing_s(),
            None,
            "a point that leaves does not impact"
        );
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
