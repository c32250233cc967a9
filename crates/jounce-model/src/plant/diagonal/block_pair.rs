//! Block of two states of a diagonalised plant.

use jounce_linalg::c64;

/// A 2 x 2 block acting on `(u, v)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BlockPair {
    /// A complex pair `decay +- i frequency`: `u + i v` rotates and decays. Rates in 1/s and rad/s.
    Oscillatory {
        /// Real part of the eigenvalue, 1/s.
        decay: f64,
        /// Imaginary part of the eigenvalue, rad/s.
        frequency: f64,
    },
    /// A double real eigenvalue with one eigenvector: `u' = rate u + v`, `v' = rate v`.
    Jordan {
        /// The eigenvalue, 1/s.
        rate: f64,
    },
    /// Displacement and velocity of a free body: `u' = v`, `v' = rate v`. The displacement is the
    /// integral of the velocity, so that no digits are lost however small the rate is.
    FreeBody {
        /// Rate of the velocity, 1/s; 0 without losses.
        rate: f64,
    },
}

impl BlockPair {
    /// Returns the entries `[a, b, c, d]` of the block, row by row, 1/s.
    pub fn matrix(&self) -> [f64; 4] {
        match *self {
            BlockPair::Oscillatory { decay, frequency } => [decay, -frequency, frequency, decay],
            BlockPair::Jordan { rate } => [rate, 1.0, 0.0, rate],
            BlockPair::FreeBody { rate } => [0.0, 1.0, 0.0, rate],
        }
    }

    /// Returns the entries of the matrix `N` in the flow `a I + b N`: `a` is the entry of the flow in
    /// row and column `v`, `b` the entry in row `v` (of an oscillation) or `u` of the other column.
    pub fn crossing(&self) -> [f64; 4] {
        match *self {
            BlockPair::Oscillatory { .. } => [0.0, -1.0, 1.0, 0.0],
            BlockPair::Jordan { .. } => [0.0, 1.0, 0.0, 0.0],
            BlockPair::FreeBody { rate } => [-rate, 1.0, 0.0, 0.0],
        }
    }

    /// Returns the entries of the exact flow over `time_s`.
    pub fn flow(&self, time_s: f64) -> [f64; 4] {
        match *self {
            BlockPair::Oscillatory { decay, frequency } => {
                let (sin, cos) = (frequency * time_s).sin_cos();
                let envelope = (decay * time_s).exp();
                [
                    envelope * cos,
                    -envelope * sin,
                    envelope * sin,
                    envelope * cos,
                ]
            }
            BlockPair::Jordan { rate } => {
                let envelope = (rate * time_s).exp();
                [envelope, envelope * time_s, 0.0, envelope]
            }
            BlockPair::FreeBody { rate } => {
                let distance = exponential_integral_s(c64::new(rate, 0.0), time_s).re;
                [1.0, distance, 0.0, (rate * time_s).exp()]
            }
        }
    }

    /// Returns the entries of the integral of the flow from 0 to `time_s`, s.
    pub fn integral(&self, time_s: f64) -> [f64; 4] {
        match *self {
            BlockPair::Oscillatory { .. } => {
                let integral = exponential_integral_s(self.eigenvalue(), time_s);
                [integral.re, -integral.im, integral.im, integral.re]
            }
            BlockPair::Jordan { rate } => {
                // int t e^(rate t) dt
                let (z, first_integral) = (
                    rate * time_s,
                    exponential_integral_s(c64::new(rate, 0.0), time_s).re,
                );
                let twice = if z.abs() < 1.0 {
                    time_s * time_s * series(z, |k| f64::from(k + 2))
                } else {
                    (time_s * z.exp() - first_integral) / rate
                };
                [first_integral, twice, 0.0, first_integral]
            }
            BlockPair::FreeBody { rate } => {
                // int (e^(rate t) - 1) / rate dt
                let (z, distance) = (
                    rate * time_s,
                    exponential_integral_s(c64::new(rate, 0.0), time_s).re,
                );
                let moved = if z.abs() < 1.0 {
                    time_s * time_s * series(z, |k| f64::from((k + 1) * (k + 2)))
                } else {
                    (distance - time_s) / rate
                };
                [time_s, moved, 0.0, distance]
            }
        }
    }

    /// Returns the eigenvalue with non-negative imaginary part; of a free body, that of its velocity.
    pub fn eigenvalue(&self) -> c64 {
        match *self {
            BlockPair::Oscillatory { decay, frequency } => c64::new(decay, frequency),
            BlockPair::Jordan { rate } | BlockPair::FreeBody { rate } => c64::new(rate, 0.0),
        }
    }

    /// Returns the other eigenvalue.
    pub fn other_eigenvalue(&self) -> c64 {
        match self {
            BlockPair::FreeBody { .. } => c64::new(0.0, 0.0),
            _ => self.eigenvalue().conj(),
        }
    }
}

/// Returns `sum_k z^k / (k! divisor(k))` for `|z| < 1`, without the cancellation of a closed form.
fn series(z: f64, divisor: impl Fn(i32) -> f64) -> f64 {
    let terms = (0..24).scan(1.0, |power, k: i32| {
        let term = *power / divisor(k);
        *power *= z / f64::from(k + 1);
        Some(term)
    });
    terms.sum()
}

/// Returns the integral of `e^(rate s)` over a time, `(e^(rate t) - 1) / rate`, s, without
/// cancellation.
pub fn exponential_integral_s(rate: c64, time_s: f64) -> c64 {
    let z = rate * time_s;
    if z == c64::new(0.0, 0.0) {
        return c64::new(time_s, 0.0);
    }
    // `e^(i b) - 1 = 2 i sin(b / 2) e^(i b / 2)`
    let (growth, (sin, cos)) = (z.re.exp_m1(), (0.5 * z.im).sin_cos());
    let turn = c64::new(-2.0 * sin * sin, 2.0 * sin * cos);
    (turn * (1.0 + growth) + growth) / rate
}
