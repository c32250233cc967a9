//! Coefficients of the Taylor series of a motion in one phase of the contacts.
//!
//! ```text
//! y' = f(y, sin, cos)    dt = g ds    g = u^(m - 1)    u^m = d
//! ```
//!
//! A force `k d^n` has no series at the surface where `n` is no integer. It has one in `u` and in
//! the independent variable `s` where `m n` is an integer, because `du/ds = d' / m` and
//! `dt/ds = u^(m - 1)`: the contact takes a finite length in `s`, and `u` vanishes with a slope at
//! both of its ends. In every other phase `m = 1` and `s` is the time.
//!
//! Coefficients follow from the recurrences of products of series: A. Jorba and M. Zou, *A software
//! package for the numerical integration of ODEs by means of high-order Taylor methods*, Experimental
//! Mathematics 14 (2005) 99.

use super::law::{Law, Phase};
use super::model::{Phases, ReferenceModel, STOPS};

/// Order of the series.
pub const ORDER: usize = 24;

/// Coefficients of a scalar.
pub type Coefficients = [f64; ORDER + 1];

/// Force of the contact that is no linear function of the state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Force {
    /// None: all forces are linear.
    Linear,
    /// `k d^1.5 (1 + a d')` of a stop, `m = 2`.
    Root2 { p: usize, k: f64, a: f64 },
    /// `k d^1.2 (1 + a d')`, `m = 5`.
    Root5 { p: usize, k: f64, a: f64 },
    /// `k d^2 (1 + a d')`, `m = 1`.
    Square { p: usize, k: f64, a: f64 },
    /// `k d + k3 d^3`, `m = 1`.
    Cubic { p: usize, k: f64, k3: f64 },
}

impl Force {
    /// Number of the stop.
    pub fn stop(self) -> Option<usize> {
        match self {
            Force::Linear => None,
            Force::Root2 { p, .. }
            | Force::Root5 { p, .. }
            | Force::Square { p, .. }
            | Force::Cubic { p, .. } => Some(p),
        }
    }

    /// The exponent `m`.
    pub fn root(self) -> f64 {
        match self {
            Force::Root2 { .. } => 2.0,
            Force::Root5 { .. } => 5.0,
            _ => 1.0,
        }
    }
}

impl<const N: usize, const D: usize> ReferenceModel<N, D> {
    /// Returns the force that is not linear, or `None` where a phase has no series here.
    pub fn series_force(&self, phases: &Phases) -> Option<Force> {
        let mut force = Force::Linear;
        if phases == &[Phase::Resting; STOPS] {
            return None;
        }
        for (p, stop) in self.stops.iter().enumerate() {
            match phases[p] {
                Phase::Pushing if stop.law.linear().is_none() => {
                    if force != Force::Linear {
                        return None;
                    }
                    force = match stop.law {
                        Law::Power { k, n: 1.5, a } => Force::Root2 { p, k, a },
                        Law::Power { k, n: 1.2, a } => Force::Root5 { p, k, a },
                        Law::Power { k, n: 2.0, a } => Force::Square { p, k, a },
                        Law::Cubic { k, k3 } => Force::Cubic { p, k, k3 },
                        _ => return None,
                    };
                }
                _ => {}
            }
        }
        Some(force)
    }
}

/// Series of a motion.
pub struct Series<const D: usize> {
    /// State, with a constant energy.
    pub state: [[f64; D]; ORDER + 1],
    /// Time since the start of the step.
    pub time: Coefficients,
    /// The variable `u`; unused without a force.
    pub root: Coefficients,
    /// Acceleration towards the stop that a sticking point would have without it.
    pub hold: Coefficients,
}

/// Coefficients in both orders, zero where they are not computed yet, so that every product is a sum
/// of the same number of terms.
#[derive(Clone, Copy)]
struct Factor {
    forward: [f64; ORDER],
    backward: [f64; 2 * ORDER],
}

/// Number of sums of a product, for vector instructions.
const SUMS: usize = 8;

impl Factor {
    const ZERO: Self = Self {
        forward: [0.0; ORDER],
        backward: [0.0; 2 * ORDER],
    };

    #[inline(always)]
    fn set(&mut self, k: usize, value: f64) {
        self.forward[k] = value;
        self.backward[ORDER - 1 - k] = value;
    }

    /// Coefficient number `k` of a product.
    #[inline(always)]
    fn times(&self, other: &Self, k: usize) -> f64 {
        let other = &other.backward[ORDER - 1 - k..][..ORDER];
        let mut sums = [0.0; SUMS];
        for block in 0..ORDER / SUMS {
            for i in 0..SUMS {
                sums[i] += self.forward[SUMS * block + i] * other[SUMS * block + i];
            }
        }
        ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]))
    }
}

/// Series that are needed only while the coefficients are computed.
struct Products<const D: usize> {
    rate: [[f64; D]; ORDER],
    sine: Factor,
    cosine: Factor,
    /// `u`, `u^2`, `g` and `u^(m n)`.
    root: Factor,
    square: Factor,
    speed: Factor,
    power: Factor,
    /// `1 + a d'`.
    damping: Factor,
}

impl<const D: usize> Products<D> {
    fn new() -> Self {
        Self {
            rate: [[0.0; D]; ORDER],
            sine: Factor::ZERO,
            cosine: Factor::ZERO,
            root: Factor::ZERO,
            square: Factor::ZERO,
            speed: Factor::ZERO,
            power: Factor::ZERO,
            damping: Factor::ZERO,
        }
    }

    /// Coefficient number `k` of the force of a stop at those of `u` and of the velocity.
    #[inline(always)]
    fn force(&mut self, force: Force, k: usize, (u, velocity): (f64, f64)) -> f64 {
        self.root.set(k, u);
        let (stiffness, a) = match force {
            Force::Linear => return 0.0,
            Force::Cubic { k: linear, k3, .. } => {
                self.square.set(k, self.root.times(&self.root, k));
                return linear * u + k3 * self.square.times(&self.root, k);
            }
            Force::Root2 {
                k: stiffness, a, ..
            } => {
                self.square.set(k, self.root.times(&self.root, k));
                self.speed.set(k, u);
                self.power.set(k, self.square.times(&self.root, k));
                (stiffness, a)
            }
            Force::Root5 {
                k: stiffness, a, ..
            } => {
                self.square.set(k, self.root.times(&self.root, k));
                self.speed.set(k, self.square.times(&self.square, k));
                self.power.set(k, self.speed.times(&self.square, k));
                (stiffness, a)
            }
            Force::Square {
                k: stiffness, a, ..
            } => {
                self.power.set(k, self.root.times(&self.root, k));
                (stiffness, a)
            }
        };
        if a == 0.0 {
            return stiffness * self.power.forward[k];
        }
        let constant = if k == 0 { 1.0 } else { 0.0 };
        self.damping.set(k, a * velocity + constant);
        stiffness * self.power.times(&self.damping, k)
    }

    /// Derivatives by `s` of the state, sine, cosine and time at coefficient `k`.
    #[inline(always)]
    fn derivatives(&self, force: Force, k: usize) -> ([f64; D], [f64; 3]) {
        if force.root() == 1.0 {
            let time = if k == 0 { 1.0 } else { 0.0 };
            let clock = [self.cosine.forward[k], -self.sine.forward[k], time];
            return (self.rate[k], clock);
        }
        let g = &self.speed;
        let (mut even, mut odd) = ([0.0; D], [0.0; D]);
        for j in (0..=k).step_by(2) {
            // The second coefficient is zero beyond the last one.
            let (a, b) = (g.forward[j], if j < k { g.forward[j + 1] } else { 0.0 });
            let (left, right) = (&self.rate[k - j], &self.rate[k.max(j + 1) - j - 1]);
            for i in 0..D {
                even[i] += a * left[i];
                odd[i] += b * right[i];
            }
        }
        let mut state = [0.0; D];
        (0..D).for_each(|i| state[i] = even[i] + odd[i]);
        let clock = [
            g.times(&self.cosine, k),
            -g.times(&self.sine, k),
            g.forward[k],
        ];
        (state, clock)
    }
}

impl<const N: usize, const D: usize> ReferenceModel<N, D> {
    /// Computes the series from a state at a time; `root` is `u` there.
    pub fn series(
        &self,
        (t, y): (f64, &[f64; D]),
        phases: &Phases,
        (force, root): (Force, f64),
    ) -> Series<D> {
        let mut series = Series {
            state: [[0.0; D]; ORDER + 1],
            time: [0.0; ORDER + 1],
            root: [0.0; ORDER + 1],
            hold: [0.0; ORDER + 1],
        };
        let mut products = Products::new();
        (series.state[0], series.root[0]) = (*y, root);
        let (mut sine, mut cosine) = self.drive_angle(t).sin_cos();
        for k in 0..ORDER {
            let constant = if k == 0 { 1.0 } else { 0.0 };
            let y = &series.state[k];
            products.sine.set(k, sine);
            products.cosine.set(k, cosine);
            let mut rate = self.linear_rate(y, sine, constant);
            let mut closing = 0.0;
            for (p, stop) in self.stops.iter().enumerate() {
                if phases[p] != Phase::Pushing {
                    continue;
                }
                let [along, speed] = stop.along(y);
                let size = if let Some([k, c]) = stop.law.linear() {
                    k * (along - constant * stop.gap) + c * speed
                } else {
                    closing = speed;
                    products.force(force, k, (series.root[k], speed))
                };
                (0..N).for_each(|i| rate[N + i] -= stop.shape[i] * size);
            }
            for (stop, phase) in self.stops.iter().zip(phases) {
                if *phase == Phase::Resting {
                    series.hold[k] = stop.along(&rate)[1];
                    let size = series.hold[k] / stop.square;
                    (0..N).for_each(|i| rate[N + i] -= stop.shape[i] * size);
                }
            }
            products.rate[k] = rate;
            let (state, clock) = products.derivatives(force, k);
            let next = ((k + 1) as f64).recip();
            (0..D).for_each(|i| series.state[k + 1][i] = next * state[i]);
            sine = next * self.angular() * clock[0];
            cosine = next * self.angular() * clock[1];
            series.time[k + 1] = next * clock[2];
            series.root[k + 1] = next * closing / force.root();
        }
        series
    }
}
