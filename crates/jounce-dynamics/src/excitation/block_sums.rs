//! Sums over vectors of blocks with `N` states each, in registers.

use jounce_model::plant::SignalSample;
use jounce_simd::{F64x8, Simd};

/// A vector of blocks with `N` states each.
pub trait Blocks<W: Simd, const N: usize>: Copy {
    /// Multiplies states by the blocks.
    fn apply(self, w: W, state: [W::Register; N]) -> [W::Register; N];
}

/// Entries `a, b, c, d` of pairs.
#[derive(Clone, Copy)]
pub struct Pairs<R>(pub [R; 4]);

/// Single rates.
#[derive(Clone, Copy)]
pub struct Reals<R>(pub R);

impl<W: Simd> Blocks<W, 2> for Pairs<W::Register> {
    #[inline(always)]
    fn apply(self, w: W, [u, v]: [W::Register; 2]) -> [W::Register; 2] {
        let [a, b, c, d] = self.0;
        [w.fma(a, u, w.mul(b, v)), w.fma(c, u, w.mul(d, v))]
    }
}

impl<W: Simd> Blocks<W, 1> for Reals<W::Register> {
    #[inline(always)]
    fn apply(self, w: W, [u]: [W::Register; 1]) -> [W::Register; 1] {
        [w.mul(self.0, u)]
    }
}

/// Returns `B_0` and `B_1`, the sums of the columns of all signals times their values and their
/// slopes.
#[inline(always)]
pub fn columns<'c, W: Simd, const N: usize>(
    w: W,
    lanes: [usize; N],
    columns: impl Iterator<Item = &'c Vec<F64x8>>,
    sizes: &[SignalSample],
) -> [[W::Register; N]; 2] {
    let mut sums = [[w.zero(); N]; 2];
    for (column, [value, slope]) in columns.zip(sizes) {
        let column = load(w, lanes, column);
        sums[0] = scaled(w, *value, column, sums[0]);
        sums[1] = scaled(w, *slope, column, sums[1]);
    }
    sums
}

/// Adds `u_z X_0 + s_z X_1` to the sum of each signal in some blocks, which have a factor of 1; the
/// others have a factor of 0.
#[inline(always)]
pub fn add_to_signals<'c, W: Simd, const N: usize>(
    w: W,
    lanes: [usize; N],
    integrals: [[W::Register; N]; 2],
    (sizes, blocks): (&[SignalSample], impl Iterator<Item = &'c F64x8>),
    sums: &mut [Vec<F64x8>],
) {
    for ((sum, [value, slope]), factor) in sums.iter_mut().zip(sizes).zip(blocks) {
        let factor = w.load(factor);
        let [first, second] = integrals.map(|integral| integral.map(|x| w.mul(factor, x)));
        let by_value = scaled(w, *value, first, load(w, lanes, sum));
        let by_both = scaled(w, *slope, second, by_value);
        for (lane, register) in lanes.into_iter().zip(by_both) {
            sum[lane] = w.store(register);
        }
    }
}

/// Loads vectors of a state.
#[inline(always)]
pub fn load<W: Simd, const N: usize>(w: W, lanes: [usize; N], state: &[F64x8]) -> [W::Register; N] {
    lanes.map(|lane| w.load(&state[lane]))
}

/// Returns `sum + factor state`.
#[inline(always)]
pub fn scaled<W: Simd, const N: usize>(
    w: W,
    factor: f64,
    state: [W::Register; N],
    mut sum: [W::Register; N],
) -> [W::Register; N] {
    let factor = w.splat(factor);
    for (sum, state) in sum.iter_mut().zip(state) {
        *sum = w.fma(factor, state, *sum);
    }
    sum
}

/// Returns `a + b`.
#[inline(always)]
pub fn add<W: Simd, const N: usize>(
    w: W,
    mut a: [W::Register; N],
    b: [W::Register; N],
) -> [W::Register; N] {
    for (a, b) in a.iter_mut().zip(b) {
        *a = w.add(*a, b);
    }
    a
}
