//! Arithmetic on eight numbers in registers.

use super::f64x8::{F64x8, LANES};
use pulp::bytemuck::{Pod, cast};
use pulp::{Scalar, Simd as PulpSimd};

/// Arithmetic on eight numbers at once.
pub trait Simd: Copy {
    /// Eight numbers in registers.
    type Register: Copy;

    /// Loads from memory.
    fn load(self, numbers: &F64x8) -> Self::Register;

    /// Stores to memory.
    fn store(self, register: Self::Register) -> F64x8;

    /// Broadcasts one number to eight.
    fn splat(self, value: f64) -> Self::Register;

    /// Returns `a b + c`, fused where the machine supports it.
    fn fma(self, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register;

    /// Returns `a b + c` of single numbers, fused where the machine supports it.
    fn fma_one(self, a: f64, b: f64, c: f64) -> f64;

    /// Returns `a + b`.
    fn add(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// Returns `a - b`.
    fn sub(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// Returns `a b`.
    fn mul(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// Returns `a / b`.
    fn div(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// Returns the larger number of each pair.
    fn max(self, a: Self::Register, b: Self::Register) -> Self::Register;

    /// Returns the magnitudes.
    fn abs(self, a: Self::Register) -> Self::Register;

    /// Returns the square roots.
    fn sqrt(self, a: Self::Register) -> Self::Register;

    /// Returns the sum of the eight numbers, in the same order on every machine.
    fn sum(self, a: Self::Register) -> f64;

    /// Returns the largest of the eight numbers.
    fn largest(self, a: Self::Register) -> f64;

    /// Calls a function, itself `#[inline(always)]`, as separate code with the same instructions:
    /// shared code is compiled once.
    fn out_of_line<R>(self, function: impl FnOnce() -> R) -> R;

    /// Returns eight zeros.
    #[inline(always)]
    fn zero(self) -> Self::Register {
        self.splat(0.0)
    }
}

/// `N` registers of the instruction set `S` that hold eight numbers.
#[derive(Debug, Clone, Copy)]
pub struct Registers<S, const N: usize>(pub S);

/// Scalar implementation, for code off the hot path.
pub type Portable = Registers<Scalar, LANES>;

impl Portable {
    /// Returns the only value of this type.
    pub const fn new() -> Self {
        Registers(Scalar)
    }
}

impl Default for Portable {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: PulpSimd, const N: usize> Registers<S, N>
where
    [S::f64s; N]: Pod,
{
    #[inline(always)]
    fn one(self, a: [S::f64s; N], function: impl Fn(S, S::f64s) -> S::f64s) -> [S::f64s; N] {
        let mut out = a;
        for i in 0..N {
            out[i] = function(self.0, a[i]);
        }
        out
    }

    #[inline(always)]
    fn two(
        self,
        a: [S::f64s; N],
        b: [S::f64s; N],
        function: impl Fn(S, S::f64s, S::f64s) -> S::f64s,
    ) -> [S::f64s; N] {
        let mut out = a;
        for i in 0..N {
            out[i] = function(self.0, a[i], b[i]);
        }
        out
    }
}

impl<S: PulpSimd, const N: usize> Registers<S, N>
where
    [S::f64s; N]: Pod,
{
    /// Combines the first half of the registers with the second, until one is left; [`PulpSimd`]
    /// continues the reduction inside it.
    #[inline(always)]
    fn folded(
        self,
        mut a: [S::f64s; N],
        function: impl Fn(S, S::f64s, S::f64s) -> S::f64s,
    ) -> S::f64s {
        let mut count = N;
        while count > 1 {
            count /= 2;
            for i in 0..count {
                a[i] = function(self.0, a[i], a[i + count]);
            }
        }
        a[0]
    }
}

impl<S: PulpSimd, const N: usize> Simd for Registers<S, N>
where
    [S::f64s; N]: Pod,
{
    type Register = [S::f64s; N];

    #[inline(always)]
    fn out_of_line<R>(self, function: impl FnOnce() -> R) -> R {
        self.0.vectorize(function)
    }

    #[inline(always)]
    fn load(self, numbers: &F64x8) -> Self::Register {
        cast(numbers.0)
    }

    #[inline(always)]
    fn store(self, register: Self::Register) -> F64x8 {
        F64x8(cast(register))
    }

    #[inline(always)]
    fn splat(self, value: f64) -> Self::Register {
        [self.0.splat_f64s(value); N]
    }

    #[inline(always)]
    fn fma(self, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register {
        let mut out = c;
        for i in 0..N {
            out[i] = self.0.mul_add_e_f64s(a[i], b[i], c[i]);
        }
        out
    }

    #[inline(always)]
    fn fma_one(self, a: f64, b: f64, c: f64) -> f64 {
        // Without such an instruction a library call would dominate the cost.
        if S::F64_LANES >= 4 {
            a.mul_add(b, c)
        } else {
            a * b + c
        }
    }

    #[inline(always)]
    fn add(self, a: Self::Register, b: Self::Register) -> Self::Register {
        self.two(a, b, |simd, a, b| simd.add_f64s(a, b))
    }

    #[inline(always)]
    fn sub(self, a: Self::Register, b: Self::Register) -> Self::Register {
        self.two(a, b, |simd, a, b| simd.sub_f64s(a, b))
    }

    #[inline(always)]
    fn mul(self, a: Self::Register, b: Self::Register) -> Self::Register {
        self.two(a, b, |simd, a, b| simd.mul_f64s(a, b))
    }

    #[inline(always)]
    fn div(self, a: Self::Register, b: Self::Register) -> Self::Register {
        self.two(a, b, |simd, a, b| simd.div_f64s(a, b))
    }

    #[inline(always)]
    fn max(self, a: Self::Register, b: Self::Register) -> Self::Register {
        self.two(a, b, |simd, a, b| simd.max_f64s(a, b))
    }

    #[inline(always)]
    fn abs(self, a: Self::Register) -> Self::Register {
        self.one(a, |simd, a| simd.abs_f64s(a))
    }

    #[inline(always)]
    fn sqrt(self, a: Self::Register) -> Self::Register {
        self.one(a, |simd, a| simd.sqrt_f64s(a))
    }

    #[inline(always)]
    fn sum(self, a: Self::Register) -> f64 {
        self.0
            .reduce_sum_f64s(self.folded(a, |simd, a, b| simd.add_f64s(a, b)))
    }

    #[inline(always)]
    fn largest(self, a: Self::Register) -> f64 {
        self.0
            .reduce_max_f64s(self.folded(a, |simd, a, b| simd.max_f64s(a, b)))
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
