//! Eight numbers side by side: the width in which marching works, written so that the compiler turns it into vector code.
//!
//! `FMA` says whether the machine fuses multiply and add; without it `mul_add` would be a slow library call.

/// Numbers per lane: seven collocation nodes and the end of the step.
pub const WIDTH: usize = 8;

/// Eight numbers on one cache line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(64))]
pub struct Lane(pub [f64; WIDTH]);

/// `a b + c`.
#[inline(always)]
pub fn fma<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}

impl Lane {
    /// All zero.
    pub const ZERO: Lane = Lane([0.0; WIDTH]);

    /// One number eight times.
    #[inline(always)]
    pub fn splat(value: f64) -> Lane {
        Lane([value; WIDTH])
    }

    /// `self + factor * other`.
    #[inline(always)]
    pub fn add_scaled<const FMA: bool>(mut self, factor: f64, other: &Lane) -> Lane {
        for i in 0..WIDTH {
            self.0[i] = fma::<FMA>(factor, other.0[i], self.0[i]);
        }
        self
    }

    /// `self + a * b`, number by number.
    #[inline(always)]
    pub fn add_product<const FMA: bool>(mut self, a: &Lane, b: &Lane) -> Lane {
        for i in 0..WIDTH {
            self.0[i] = fma::<FMA>(a.0[i], b.0[i], self.0[i]);
        }
        self
    }

    /// Sum of both.
    #[inline(always)]
    pub fn add(mut self, other: &Lane) -> Lane {
        for i in 0..WIDTH {
            self.0[i] += other.0[i];
        }
        self
    }

    /// Applies a function to each number.
    #[inline(always)]
    pub fn map(mut self, function: impl Fn(f64) -> f64) -> Lane {
        for value in &mut self.0 {
            *value = function(*value);
        }
        self
    }

    /// Sum of the eight numbers, in a fixed order.
    #[inline(always)]
    pub fn sum(&self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }

    /// Largest of the eight magnitudes.
    #[inline(always)]
    pub fn max_abs(&self) -> f64 {
        let m: [f64; 4] = std::array::from_fn(|i| self.0[i].abs().max(self.0[i + 4].abs()));
        m[0].max(m[2]).max(m[1].max(m[3]))
    }
}
