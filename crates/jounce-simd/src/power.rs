//! Powers of eight positive numbers at once.
//!
//! ```text
//! x = 2^k m,   log2 m = (2 / ln 2) artanh s,   s = (m - 1) / (m + 1),   x^n = 2^r 2^(n k - r + n log2 m)
//! ```
//!
//! `m` lies between the roots of 1/2 and of 2, and `r` is the integer nearest to `n log2 x`. The
//! series of both functions are long enough for double precision. `n k - r` is rounded once, so
//! that the error is a few roundoffs for any `k`.

use super::f64x8::{F64x8, LANES};
use super::registers::Simd;
use std::f64::consts::LN_2;

/// Number of terms of the logarithm: `s^2` is at most 0.0295.
const LOGARITHM_TERMS: usize = 12;

/// Coefficients of `log2 m` in odd powers of `s`.
const LOGARITHM: [f64; LOGARITHM_TERMS] = {
    let mut series = [0.0; LOGARITHM_TERMS];
    let mut j = 0;
    while j < LOGARITHM_TERMS {
        series[j] = 2.0 / (LN_2 * (2 * j + 1) as f64);
        j += 1;
    }
    series
};

/// Number of terms of the exponential: its argument is at most `ln 2 / 2`.
const EXPONENTIAL_TERMS: usize = 14;

/// Coefficients of `2^x`.
const EXPONENTIAL: [f64; EXPONENTIAL_TERMS] = {
    let mut series = [1.0; EXPONENTIAL_TERMS];
    let mut j = 1;
    while j < EXPONENTIAL_TERMS {
        series[j] = series[j - 1] * LN_2 / j as f64;
        j += 1;
    }
    series
};

/// Bits of the mantissa.
const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// Bits of 1.
const ONE: u64 = 1.0_f64.to_bits();

/// Exponent of 1 as it is stored.
const BIAS: u64 = ONE >> MANTISSA_BITS;

/// Number whose last mantissa bit is worth 1: in a sum with it, the last bits are an integer.
const UNIT_BIT: f64 = (1_u64 << MANTISSA_BITS) as f64;

/// Returns `base^exponent` for numbers of at least zero and an exponent of at least one; zero where
/// the base or the power is below the normal numbers.
#[inline(always)]
pub fn power<W: Simd>(w: W, base: W::Register, exponent: f64) -> W::Register {
    let base = w.store(base);
    let (mut stored_exponent, mut mantissa) = (F64x8::ZERO, F64x8::ZERO);
    for i in 0..LANES {
        let bits = base.0[i].to_bits();
        let shifted =
            bits.wrapping_add(ONE - std::f64::consts::FRAC_1_SQRT_2.to_bits()) >> MANTISSA_BITS;
        stored_exponent.0[i] = f64::from_bits(shifted | UNIT_BIT.to_bits());
        mantissa.0[i] = f64::from_bits(
            bits.wrapping_sub(shifted << MANTISSA_BITS)
                .wrapping_add(ONE),
        );
    }
    let (one, n) = (w.splat(1.0), w.splat(exponent));
    let k = w.sub(w.load(&stored_exponent), w.splat(UNIT_BIT + BIAS as f64));
    let m = w.load(&mantissa);
    let s = w.div(w.sub(m, one), w.add(m, one));
    let logarithm = w.mul(s, sum(w, &LOGARITHM, w.mul(s, s)));
    let total = w.fma(n, logarithm, w.mul(n, k));
    let rounder = w.splat(1.5 * UNIT_BIT);
    let rounded = w.add(total, rounder);
    let r = w.sub(rounded, rounder);
    let rest = w.fma(n, logarithm, w.fma(n, k, w.sub(w.zero(), r)));
    let (total, rounded) = (w.store(total), w.store(rounded));
    let mut scale = F64x8::ZERO;
    for i in 0..LANES {
        let normal = f64::from_bits(rounded.0[i].to_bits().wrapping_add(BIAS) << MANTISSA_BITS);
        scale.0[i] = if base.0[i] < f64::MIN_POSITIVE || total.0[i] < f64::MIN_EXP as f64 {
            0.0
        } else if total.0[i] < (f64::MAX_EXP - 1) as f64 {
            normal
        } else {
            base.0[i] * f64::MAX
        };
    }
    w.mul(w.load(&scale), sum(w, &EXPONENTIAL, rest))
}

/// Returns a sum of ascending powers.
// A loop: the compiler does not inline `Iterator::rfold` everywhere, and around a call registers are
// written to memory.
#[inline(always)]
fn sum<W: Simd>(w: W, coefficients: &[f64], x: W::Register) -> W::Register {
    let mut sum = w.zero();
    for coefficient in coefficients.iter().rev() {
        sum = w.fma(sum, x, w.splat(*coefficient));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Task, widest};

    struct Power(F64x8, f64);

    impl Task for Power {
        type Output = F64x8;

        #[inline(always)]
        fn run<W: Simd>(self, w: W) -> F64x8 {
            w.store(power(w, w.load(&self.0), self.1))
        }
    }

    #[test]
    fn agrees_with_the_library_to_a_few_roundoffs() {
        let mut worst: f64 = 0.0;
        for exponent in [1.0, 1.1, 1.2, 1.3, 1.75, 2.0, 2.5, 3.0, 7.3] {
            for step in 0..100_000 {
                let base = F64x8(std::array::from_fn(|i| {
                    (0.0047 * f64::from(step) - 400.0 + 31.0 * i as f64).exp2()
                        * (1.0 + 0.1 * i as f64)
                }));
                let powers = widest(Power(base, exponent));
                for (base, power) in base.0.iter().zip(powers.0) {
                    let expected = base.powf(exponent);
                    if expected > 1e-300 && expected < 1e300 {
                        worst = worst.max((power / expected - 1.0).abs());
                    }
                }
            }
        }
        assert!(worst < 6.0 * f64::EPSILON, "{worst:e}");
    }

    #[test]
    fn limits_are_those_of_the_library() {
        let base = F64x8([
            0.0,
            1e-310,
            1e-200,
            1.0,
            1e200,
            f64::MAX,
            f64::INFINITY,
            f64::NAN,
        ]);
        let powers = widest(Power(base, 2.5)).0;
        assert_eq!(powers[..4], [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(powers[4..7], [f64::INFINITY; 3]);
        assert!(powers[7].is_nan());
    }
}
