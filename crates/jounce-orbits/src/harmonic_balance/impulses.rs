//! State at the end of a period after many impulses.
//!
//! ```text
//! y = sum_q I_q e^(A t_q) b
//! ```
//!
//! `t_q` is the remaining time (s), `I_q` the impulse (N s). A complex pair of `A` rotates as one
//! number, so that its part is `(b_u + i b_v) sum_q I_q e^(s t_q)`, eight terms per vector. Each
//! term is Taylor's series of `e^(s t / 2^k)`, squared `k` times. Each squaring doubles the
//! roundoff: 1e-12 at a rotation of 2^10 rad.

use super::angles::lanes;
use jounce_linalg::c64;
use jounce_model::plant::{BlockDiagonal, BlockPair};
use jounce_simd::{F64x8, Simd, Task, widest};

/// Terms of the series: at an argument of `1/8` the remainder is `(1/8)^11 / 11! = 3e-18`.
const SERIES_TERMS: usize = 10;

/// Returns the block coordinates after the impulses on a column `b`; 0 for pairs that rotate faster
/// than `fastest_rad_s`.
pub fn after_impulses(
    block: &BlockDiagonal,
    column: &[f64],
    fastest_rad_s: f64,
    remaining_s: &[f64],
    impulses_n_s: &[f64],
) -> Vec<f64> {
    let (times, impulses) = (lanes(remaining_s), lanes(impulses_n_s));
    let longest_s = remaining_s.iter().fold(0.0_f64, |max, time| max.max(*time));
    let mut state = Vec::with_capacity(column.len());
    let (paired, single) = column.split_at(2 * block.pairs.len());
    for (pair, b) in block.pairs.iter().zip(paired.chunks_exact(2)) {
        let rate = pair.eigenvalue();
        match pair {
            _ if rate.norm() > fastest_rad_s => state.extend([0.0; 2]),
            BlockPair::Oscillatory { .. } => {
                let squarings = (8.0 * rate.norm() * longest_s).max(1.0).log2().ceil() as u32;
                let sum = widest(ImpulseSum {
                    times: &times,
                    impulses: &impulses,
                    rate,
                    squarings,
                }) * c64::new(b[0], b[1]);
                state.extend([sum.re, sum.im]);
            }
            BlockPair::Jordan { .. } | BlockPair::FreeBody { .. } => {
                let mut sum = [0.0; 2];
                for (time_s, impulse) in remaining_s.iter().zip(impulses_n_s) {
                    let [a, d, c, e] = pair.flow(*time_s);
                    sum[0] += impulse * (a * b[0] + d * b[1]);
                    sum[1] += impulse * (c * b[0] + e * b[1]);
                }
                state.extend(sum);
            }
        }
    }
    let decayed = |rate: f64| -> f64 {
        remaining_s
            .iter()
            .zip(impulses_n_s)
            .map(|(time_s, impulse)| impulse * (rate * time_s).exp())
            .sum()
    };
    state.extend(
        block
            .reals
            .iter()
            .zip(single)
            .map(|(rate, b)| b * decayed(*rate)),
    );
    state
}

/// `sum_q I_q e^(s t_q)`.
struct ImpulseSum<'a> {
    times: &'a [F64x8],
    impulses: &'a [F64x8],
    rate: c64,
    squarings: u32,
}

impl Task for ImpulseSum<'_> {
    type Output = c64;

    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> c64 {
        let scale = 0.5_f64.powi(self.squarings as i32);
        let (decay, turn, one) = (
            w.splat(self.rate.re * scale),
            w.splat(self.rate.im * scale),
            w.splat(1.0),
        );
        let (mut sum_re, mut sum_im) = (w.zero(), w.zero());
        for (time, impulse) in self.times.iter().zip(self.impulses) {
            let (x, y) = (w.mul(decay, w.load(time)), w.mul(turn, w.load(time)));
            let back = w.sub(w.zero(), y);
            // 1 + z (1 + z / 2 (1 + z / 3 (...)))
            let (mut re, mut im) = (one, w.zero());
            for term in (1..=SERIES_TERMS).rev() {
                let share = w.splat(1.0 / term as f64);
                let product = (w.fma(re, x, w.mul(im, back)), w.fma(re, y, w.mul(im, x)));
                (re, im) = (w.fma(product.0, share, one), w.mul(product.1, share));
            }
            for _ in 0..self.squarings {
                let twice = w.add(re, re);
                (re, im) = (w.mul(w.add(re, im), w.sub(re, im)), w.mul(twice, im));
            }
            sum_re = w.fma(re, w.load(impulse), sum_re);
            sum_im = w.fma(im, w.load(impulse), sum_im);
        }
        c64::new(w.sum(sum_re), w.sum(sum_im))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with the exact flow of every kind of block, from a slow one to one that rotates by
    /// a thousand radians.
    #[test]
    fn impulses_flow_as_the_blocks_do() {
        let oscillatory = |decay: f64, frequency: f64| BlockPair::Oscillatory { decay, frequency };
        let pairs = vec![
            oscillatory(-0.1, 3.0),
            oscillatory(-20.0, 1e4),
            oscillatory(-2.0, 1e-3),
            BlockPair::Jordan { rate: -0.5 },
            BlockPair::FreeBody { rate: -0.2 },
        ];
        let block = BlockDiagonal {
            pairs,
            reals: vec![-3.0, 0.0],
        };
        let column: Vec<f64> = (0..block.len()).map(|i| 1.0 + 0.1 * i as f64).collect();
        let remaining_s: Vec<f64> = (0..21).map(|q| 0.004 * f64::from(q) + 0.02).collect();
        let impulses_n_s: Vec<f64> = (0..21).map(|q| (0.3 * f64::from(q)).sin()).collect();
        let computed = after_impulses(&block, &column, f64::INFINITY, &remaining_s, &impulses_n_s);
        let mut exact = vec![0.0; block.len()];
        for (time_s, impulse) in remaining_s.iter().zip(&impulses_n_s) {
            exact
                .iter_mut()
                .zip(block.flow(*time_s, &column))
                .for_each(|(sum, y)| *sum += impulse * y);
        }
        for (i, (value, exact)) in computed.iter().zip(&exact).enumerate() {
            assert!((value - exact).abs() < 1e-11, "state {i}: {value} {exact}");
        }
    }
}
