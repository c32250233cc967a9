//! Tridiagonal matrix `I - z S` of [`super::step_response`], factored for eight blocks at once.

use super::basis::BasisFunctions;
use super::step_response::BlockOnStep;
use jounce_linalg::c64;
use jounce_simd::{F64x8, Simd};

/// Row of `I - z S` factored, for eight values of `z` at once: real and imaginary parts of its
/// factors on the previous row, on the next row, and of the reciprocal pivot.
#[derive(Debug, Clone, Copy)]
pub struct TridiagonalFactors {
    pub before: [F64x8; 2],
    pub after: [F64x8; 2],
    pub inverse: [F64x8; 2],
}

/// Factors up to eight blocks on a step, with as many rows as the largest number of terms.
#[inline(always)]
pub fn factored<W: Simd>(
    w: W,
    parts: &[BlockOnStep],
    basis: &BasisFunctions,
    h: f64,
) -> Vec<TridiagonalFactors> {
    let counts = parts.iter().map(|part| terms(part, basis, h));
    factored_rows(w, parts, h, counts.max().unwrap_or(0))
}

/// Factors up to eight blocks on a step, with a number of rows.
#[inline(always)]
pub fn factored_rows<W: Simd>(
    w: W,
    parts: &[BlockOnStep],
    h: f64,
    count: usize,
) -> Vec<TridiagonalFactors> {
    let rates = |read: fn(c64) -> f64| {
        F64x8(std::array::from_fn(|i| {
            parts.get(i).map_or(0.0, |part| h * read(part.rate()))
        }))
    };
    let z = [w.load(&rates(|z| z.re)), w.load(&rates(|z| z.im))];
    let scaled = |by: f64| z.map(|part| w.mul(w.splat(by), part));
    let (one, none) = (w.splat(1.0), w.zero());
    let half = scaled(-0.5);
    let mut inverse = reciprocal(w, [w.add(one, half[0]), half[1]]);
    let mut rows = Vec::with_capacity(count);
    let stored = |pair: [W::Register; 2]| pair.map(|part| w.store(part));
    rows.push(TridiagonalFactors {
        before: stored([none, none]),
        after: stored(scaled(below(1))),
        inverse: stored(inverse),
    });
    for n in 1..count {
        let before = product(w, scaled(below(n - 1)), inverse);
        let pivot = product(w, before, scaled(below(n)));
        inverse = reciprocal(w, [w.add(one, pivot[0]), pivot[1]]);
        rows.push(TridiagonalFactors {
            before: stored(before),
            after: stored(scaled(below(n + 1))),
            inverse: stored(inverse),
        });
    }
    rows
}

/// Returns the product of complex numbers.
#[inline(always)]
fn product<W: Simd>(w: W, [a, b]: [W::Register; 2], [c, d]: [W::Register; 2]) -> [W::Register; 2] {
    [w.sub(w.mul(a, c), w.mul(b, d)), w.fma(a, d, w.mul(b, c))]
}

/// Returns the reciprocals of complex numbers.
#[inline(always)]
fn reciprocal<W: Simd>(w: W, [a, b]: [W::Register; 2]) -> [W::Register; 2] {
    let scale = w.div(w.splat(1.0), w.fma(a, a, w.mul(b, b)));
    [w.mul(a, scale), w.sub(w.zero(), w.mul(b, scale))]
}

/// Decay over a step above which a real rate needs fewer coefficients than a complex one.
const STIFF_DECAY: f64 = 300.0;

/// Returns the number of coefficients of a block on a step. For a decay `e^{-z x}` they fall off
/// like `e^{-n^2 / z}`, for a complex pair only beyond `|z| / 2`.
pub fn terms(part: &BlockOnStep, basis: &BasisFunctions, h: f64) -> usize {
    let z = h * part.rate().norm();
    let count = if z > STIFF_DECAY && part.rate().im == 0.0 {
        8.0 * z.sqrt()
    } else {
        0.75 * z
    };
    (18 + count.ceil() as usize) + basis.series.len()
}

/// Returns the entry of `S` in row `n + 1`, column `n`; the entry in row `n - 1` is its negative.
#[inline(always)]
pub fn below(n: usize) -> f64 {
    0.5 / (2 * n + 1) as f64
}
