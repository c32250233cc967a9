//! Arithmetic on eight numbers without vector instructions.

use super::f64x8::{F64x8, LANES};
use super::registers::Simd;

/// Arithmetic for machines without vector instructions and for code off the hot path. Each operation
/// is a function of its own: inlined, they would take a third of the compile time of the integration.
#[derive(Debug, Clone, Copy, Default)]
pub struct Portable;

impl Portable {
    /// Returns the only value of this type.
    pub const fn new() -> Self {
        Self
    }
}

/// Applies a function to each pair.
#[inline(always)]
fn each(mut a: F64x8, b: F64x8, function: impl Fn(f64, f64) -> f64) -> F64x8 {
    for i in 0..LANES {
        a.0[i] = function(a.0[i], b.0[i]);
    }
    a
}

/// Combines the first half with the second, until one number is left.
#[inline(always)]
fn folded(mut a: [f64; LANES], function: impl Fn(f64, f64) -> f64) -> f64 {
    let mut count = LANES;
    while count > 1 {
        count /= 2;
        for i in 0..count {
            a[i] = function(a[i], a[i + count]);
        }
    }
    a[0]
}

impl Simd for Portable {
    type Register = F64x8;

    #[inline(always)]
    fn load(self, lane: &F64x8) -> F64x8 {
        *lane
    }

    #[inline(always)]
    fn store(self, register: F64x8) -> F64x8 {
        register
    }

    #[inline(always)]
    fn splat(self, value: f64) -> F64x8 {
        F64x8([value; LANES])
    }

    #[inline(always)]
    fn fma(self, a: F64x8, b: F64x8, c: F64x8) -> F64x8 {
        let mut out = c;
        for i in 0..LANES {
            out.0[i] += a.0[i] * b.0[i];
        }
        out
    }

    #[inline(always)]
    fn fma_one(self, a: f64, b: f64, c: f64) -> f64 {
        // Without such an instruction a library call would dominate the cost.
        a * b + c
    }

    #[inline(always)]
    fn add(self, a: F64x8, b: F64x8) -> F64x8 {
        each(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, a: F64x8, b: F64x8) -> F64x8 {
        each(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, a: F64x8, b: F64x8) -> F64x8 {
        each(a, b, |a, b| a * b)
    }

    #[inline(never)]
    fn div(self, a: F64x8, b: F64x8) -> F64x8 {
        each(a, b, |a, b| a / b)
    }

    #[inline(always)]
    fn max(self, a: F64x8, b: F64x8) -> F64x8 {
        each(a, b, f64::max)
    }

    #[inline(always)]
    fn abs(self, a: F64x8) -> F64x8 {
        F64x8(a.0.map(f64::abs))
    }

    #[inline(never)]
    fn sqrt(self, a: F64x8) -> F64x8 {
        F64x8(a.0.map(f64::sqrt))
    }

    #[inline(never)]
    fn sum(self, a: F64x8) -> f64 {
        folded(a.0, |a, b| a + b)
    }

    #[inline(never)]
    fn largest(self, a: F64x8) -> f64 {
        folded(a.0, f64::max)
    }

    #[inline(never)]
    fn out_of_line<R>(self, function: impl FnOnce() -> R) -> R {
        function()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Task, widest};

    struct Every;

    impl Task for Every {
        type Output = [F64x8; 7];

        #[inline(always)]
        fn run<W: Simd>(self, simd: W) -> Self::Output {
            let a = simd.load(&F64x8([1.0, -2.0, 3.0, -4.0, 5.0, -6.0, 7.0, -8.5]));
            let b = simd.splat(0.5);
            let sums = [
                simd.sum(a),
                simd.largest(a),
                simd.sum(simd.sub(a, b)),
                0.0,
                0.0,
                0.0,
                0.0,
                0.0,
            ];
            [
                simd.store(simd.fma(a, b, b)),
                simd.store(simd.max(a, simd.zero())),
                simd.store(simd.sqrt(simd.abs(a))),
                simd.store(simd.add(a, b)),
                simd.store(simd.mul(a, b)),
                simd.store(simd.div(b, a)),
                F64x8(sums),
            ]
        }
    }

    #[test]
    fn this_machine_and_plain_numbers_agree() {
        // Every value here is exact in binary except the roots and quotients, which are correctly
        // rounded everywhere.
        assert_eq!(widest(Every), Every.run(Portable::new()));
        assert_eq!(Every.run(Portable::new())[6].0[..3], [-4.5, 7.0, -8.5]);
    }
}
