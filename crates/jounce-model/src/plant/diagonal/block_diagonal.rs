//! Blocks of a diagonalised plant and their exact flow.

use super::block_pair::{BlockPair, exponential_integral_s};
use jounce_linalg::c64;

/// Ratio to the fastest rate below which a rate is roundoff of zero; eigenvalues of coupled states
/// have an error of about 1e-13 of the fastest rate.
const ZERO_RATE: f64 = 1e-11;

/// Ratio to the fastest pair above which a decay needs no resolution, because it is quasi-static.
const STIFF_RATIO: f64 = 1e3;

/// Blocks of a plant: states are ordered `u0, v0, u1, v1, ..., r0, r1, ...`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BlockDiagonal {
    /// The 2 x 2 blocks.
    pub pairs: Vec<BlockPair>,
    /// The 1 x 1 blocks, 1/s.
    pub reals: Vec<f64>,
}

/// Exact flow of blocks over some time.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockFlow {
    pairs: Vec<[f64; 4]>,
    reals: Vec<f64>,
}

impl BlockFlow {
    /// Propagates a state.
    pub fn advance(&self, y: &mut [f64]) {
        let (paired, single) = y.split_at_mut(2 * self.pairs.len());
        for ([a, b, c, d], uv) in self.pairs.iter().zip(paired.chunks_exact_mut(2)) {
            (uv[0], uv[1]) = (a * uv[0] + b * uv[1], c * uv[0] + d * uv[1]);
        }
        single
            .iter_mut()
            .zip(&self.reals)
            .for_each(|(r, decay)| *r *= decay);
    }
}

impl BlockDiagonal {
    /// Returns the number of states.
    pub fn len(&self) -> usize {
        2 * self.pairs.len() + self.reals.len()
    }

    /// True without states.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns `A y`.
    pub fn apply(&self, y: &[f64]) -> Vec<f64> {
        self.map(y, BlockPair::matrix, |rate| rate)
    }

    /// Returns `e^{A t} y`.
    pub fn flow(&self, time_s: f64, y: &[f64]) -> Vec<f64> {
        self.map(y, |pair| pair.flow(time_s), |rate| (rate * time_s).exp())
    }

    /// Returns the row vector `c int_0^t e^{A s} ds`.
    pub fn integral_row(&self, time_s: f64, row: &[f64]) -> Vec<f64> {
        let (paired, single) = row.split_at(2 * self.pairs.len());
        let pairs = self.pairs.iter().zip(paired.chunks_exact(2));
        let reals = self.reals.iter().zip(single);
        pairs
            .flat_map(|(block, uv)| {
                let [a, b, c, d] = block.integral(time_s);
                [uv[0] * a + uv[1] * c, uv[0] * b + uv[1] * d]
            })
            .chain(
                reals.map(|(rate, r)| exponential_integral_s(c64::new(*rate, 0.0), time_s).re * r),
            )
            .collect()
    }

    /// Returns `e^{A t}` for repeated use.
    pub fn over(&self, time_s: f64) -> BlockFlow {
        let pairs = self.pairs.iter().map(|pair| pair.flow(time_s)).collect();
        BlockFlow {
            pairs,
            reals: self
                .reals
                .iter()
                .map(|rate| (rate * time_s).exp())
                .collect(),
        }
    }

    fn map(
        &self,
        y: &[f64],
        pair: impl Fn(&BlockPair) -> [f64; 4],
        real: impl Fn(f64) -> f64,
    ) -> Vec<f64> {
        let (paired, single) = y.split_at(2 * self.pairs.len());
        let transformed = self
            .pairs
            .iter()
            .zip(paired.chunks_exact(2))
            .flat_map(|(block, uv)| {
                let [a, b, c, d] = pair(block);
                [a * uv[0] + b * uv[1], c * uv[0] + d * uv[1]]
            });
        transformed
            .chain(
                self.reals
                    .iter()
                    .zip(single)
                    .map(|(rate, r)| real(*rate) * r),
            )
            .collect()
    }

    /// Returns `(s I - A)^-1 y` for a complex `s` that is not an eigenvalue.
    pub fn resolve(&self, s: c64, y: &[c64]) -> Vec<c64> {
        let mut out = Vec::with_capacity(y.len());
        for (block, uv) in self.pairs.iter().zip(y.chunks_exact(2)) {
            let [a, b, c, d] = block.matrix();
            let det = (s - a) * (s - d) - b * c;
            out.push(((s - d) * uv[0] + uv[1] * b) / det);
            out.push((uv[0] * c + (s - a) * uv[1]) / det);
        }
        let paired = 2 * self.pairs.len();
        out.extend(
            self.reals
                .iter()
                .zip(&y[paired..])
                .map(|(rate, r)| *r / (s - *rate)),
        );
        out
    }

    /// Returns the row vector `c (s I - A)^-1`.
    pub fn resolve_row(&self, s: c64, c: &[c64]) -> Vec<c64> {
        let mut out = Vec::with_capacity(c.len());
        for (block, row) in self.pairs.iter().zip(c.chunks_exact(2)) {
            let [a, b, c, d] = block.matrix();
            let det = (s - a) * (s - d) - b * c;
            out.push((row[0] * (s - d) + row[1] * c) / det);
            out.push((row[0] * b + row[1] * (s - a)) / det);
        }
        let paired = 2 * self.pairs.len();
        out.extend(
            self.reals
                .iter()
                .zip(&c[paired..])
                .map(|(rate, r)| *r / (s - *rate)),
        );
        out
    }

    /// Returns the row `c A`: the rate of the output of row `c`.
    pub fn rate_row(&self, row: &[f64]) -> Vec<f64> {
        let mut out = Vec::with_capacity(row.len());
        for (pair, c) in self.pairs.iter().zip(row.chunks_exact(2)) {
            let [a, b, d, e] = pair.matrix();
            out.extend([c[0] * a + c[1] * d, c[0] * b + c[1] * e]);
        }
        out.extend(
            self.reals
                .iter()
                .zip(&row[2 * self.pairs.len()..])
                .map(|(rate, c)| rate * c),
        );
        out
    }

    /// Returns `|eigenvalue|` of the block of each state, rad/s.
    pub fn eigenvalue_magnitudes_rad_s(&self) -> Vec<f64> {
        let pairs = self
            .pairs
            .iter()
            .flat_map(|pair| [pair.eigenvalue().norm(); 2]);
        pairs
            .chain(self.reals.iter().map(|rate| rate.abs()))
            .collect()
    }

    /// Returns the largest `|eigenvalue|` of the blocks that time steps resolve, rad/s: all except
    /// decays far faster than the pairs.
    pub fn fastest_resolved_rad_s(&self) -> f64 {
        let (bodies, pairs): (Vec<BlockPair>, Vec<BlockPair>) =
            (self.pairs.iter()).partition(|pair| matches!(pair, BlockPair::FreeBody { .. }));
        let pairs = pairs
            .iter()
            .fold(0.0, |max: f64, pair| max.max(pair.eigenvalue().norm()));
        let decays = bodies.iter().map(|pair| pair.eigenvalue().re);
        self.reals
            .iter()
            .copied()
            .chain(decays)
            .map(f64::abs)
            .filter(|rate| pairs == 0.0 || *rate <= STIFF_RATIO * pairs)
            .fold(pairs, f64::max)
    }

    /// States of blocks without a restoring effect: an eigenvalue is zero up to roundoff. Free
    /// bodies, and the charge of an open patch.
    pub fn free(&self) -> Vec<bool> {
        let zero = self.zero_rate();
        let pairs = self
            .pairs
            .iter()
            .flat_map(|pair| [pair.other_eigenvalue().norm() <= zero; 2]);
        pairs
            .chain(self.reals.iter().map(|rate| rate.abs() <= zero))
            .collect()
    }

    /// Returns the rate below which a rate is roundoff of zero, 1/s.
    pub fn zero_rate(&self) -> f64 {
        ZERO_RATE
            * self
                .eigenvalue_magnitudes_rad_s()
                .into_iter()
                .fold(0.0, f64::max)
    }

    /// Returns `A^-1 y`, with 0 for the excluded states; free states must be excluded.
    pub fn solve(&self, y: &[f64], omitted: &[bool]) -> Vec<f64> {
        let inverse = |pair: &BlockPair| {
            let [a, b, c, d] = pair.matrix();
            [d, -b, -c, a].map(|entry| entry / (a * d - b * c))
        };
        let mut out = self.map(y, inverse, |rate| 1.0 / rate);
        out.iter_mut()
            .zip(omitted)
            .filter(|(_, omitted)| **omitted)
            .for_each(|(value, _)| *value = 0.0);
        out
    }

    /// Returns all eigenvalues, with the state index of the block of each; complex pairs give both.
    pub fn eigenvalues(&self) -> Vec<c64> {
        let mut all = Vec::with_capacity(self.len());
        for pair in &self.pairs {
            all.extend([pair.eigenvalue(), pair.other_eigenvalue()]);
        }
        all.extend(self.reals.iter().map(|rate| c64::new(*rate, 0.0)));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with the sum of 2000 panels by two-point Gauss quadrature, with an error of `(A
    /// h)^4 / 4320` per panel. Measured: 3e-15 to 4e-14.
    #[test]
    fn integrals_of_the_flow_are_those_by_quadrature() {
        let pairs = vec![
            BlockPair::Oscillatory {
                decay: -0.3,
                frequency: 5.0,
            },
            BlockPair::Oscillatory {
                decay: -1e-9,
                frequency: 1e-4,
            },
            BlockPair::Jordan { rate: -4.0 },
            BlockPair::Jordan { rate: -0.2 },
            BlockPair::Jordan { rate: 0.0 },
            BlockPair::FreeBody { rate: -4.0 },
            BlockPair::FreeBody { rate: -1e-9 },
        ];
        let block = BlockDiagonal {
            pairs,
            reals: vec![-7.0, -1e-8, 0.0],
        };
        let y: Vec<f64> = (0..block.len()).map(|i| 1.0 - 0.07 * i as f64).collect();
        let (time_s, panels) = (1.7, 2000);
        let (h, half) = (time_s / f64::from(panels), 0.5 / 3.0_f64.sqrt());
        let mut sum = vec![0.0; y.len()];
        for panel in 0..panels {
            for point in [0.5 - half, 0.5 + half] {
                let at = block.flow((f64::from(panel) + point) * h, &y);
                sum.iter_mut()
                    .zip(at)
                    .for_each(|(sum, at)| *sum += 0.5 * h * at);
            }
        }
        for (i, sum) in sum.iter().enumerate() {
            let mut row = vec![0.0; y.len()];
            row[i] = 1.0;
            let row = block.integral_row(time_s, &row);
            let computed: f64 = row.iter().zip(&y).map(|(r, y)| r * y).sum();
            assert!((computed - sum).abs() < 1e-12, "{i}: {computed} {sum}");
        }
    }

    /// A rate so fast that the state vanishes, and a rate so slow that the state is unchanged.
    #[test]
    fn integrals_keep_their_digits_at_any_rate() {
        for (rate, time_s, exact) in [
            (-1e9, 1.0, 1e-9),
            (-1e-12, 3.0, 3.0 - 4.5e-12),
            (0.0, 2.0, 2.0),
        ] {
            let block = BlockDiagonal {
                pairs: Vec::new(),
                reals: vec![rate],
            };
            assert!((block.integral_row(time_s, &[1.0])[0] / exact - 1.0).abs() < 1e-15);
        }
    }
}
