//! Response of one block to the force on a step, exactly, as Legendre series in time.
//!
//! On a step scaled to `x` in `[0, 1]`, `y' = z y + g(x)` with `z = h lambda`. In Legendre
//! coefficients integration is tridiagonal,
//!
//! ```text
//! int_0^x P_n = (P_{n+1} - P_{n-1}) / (2 (2 n + 1)),   int_0^x P_0 = (P_1 + P_0) / 2,
//! ```
//!
//! so `(I - z S) y = S g` is one tridiagonal solve for any `z` with `Re z <= 0`, small or large. It
//! has no cancellation, where the usual closed form (phi functions) loses digits. The coefficients
//! fall off beyond `|z| / 2`. The free motion `e^{z x}` solves the same equations with the right
//! side `P_0`; it occupies the eighth lane of the vectors.
//!
//! Validation: the tests below compare with quadrature and closed forms at small and large `z`.

use super::basis::{BasisFunctions, NODES};
use super::factors::{TridiagonalFactors, below, factored, terms};
use super::output_rows::parts;
use jounce_linalg::c64;
use jounce_model::plant::{BlockDiagonal, BlockPair};
use jounce_simd::{F64x8, Portable, Simd};

/// Block for a step of one length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BlockOnStep {
    /// Complex pair `u + i v`.
    Turning(c64),
    /// Double real rate.
    Double(f64),
    /// Displacement and velocity of a free body, by the rate of its velocity.
    FreeBody(f64),
    /// Single real rate.
    Single(f64),
}

/// Legendre coefficients in time, row by row; lanes 0 to 6 are the responses to the nodal forces,
/// lane 7 is the free motion.
///
/// `first` is the solution for a unit force. `second` is its imaginary part for a complex pair, the
/// response to it (the same equation driven by `first`) for a double rate, and its integral for a
/// free body; 0 for a single rate.
#[derive(Debug, Clone, Default)]
pub struct StepResponse {
    /// Solution for a unit force, real part.
    pub first: Vec<F64x8>,
    /// Second series, see the type.
    pub second: Vec<F64x8>,
}

impl BlockOnStep {
    /// Returns the block of a pair.
    pub fn of(pair: &BlockPair) -> Self {
        match *pair {
            BlockPair::Oscillatory { .. } => BlockOnStep::Turning(pair.eigenvalue()),
            BlockPair::Jordan { rate } => BlockOnStep::Double(rate),
            BlockPair::FreeBody { rate } => BlockOnStep::FreeBody(rate),
        }
    }

    /// Returns the number of states of the block.
    pub fn states(&self) -> usize {
        if matches!(self, BlockOnStep::Single(_)) {
            1
        } else {
            2
        }
    }

    /// Returns the factors on `first` and `second` of the output `row` under the force `column` on
    /// a step of length `h`.
    pub fn forced(&self, row: &[f64], column: &[f64], h: f64) -> [f64; 2] {
        match self {
            BlockOnStep::Turning(_) => [
                h * (row[0] * column[0] + row[1] * column[1]),
                h * (row[1] * column[0] - row[0] * column[1]),
            ],
            BlockOnStep::Double(_) => [
                h * (row[0] * column[0] + row[1] * column[1]),
                h * h * row[0] * column[1],
            ],
            BlockOnStep::FreeBody(rate) => [
                h * (row[0] * column[0] + row[1] * column[1]),
                h * h * row[0] * (column[1] - rate * column[0]),
            ],
            BlockOnStep::Single(_) => [h * row[0] * column[0], 0.0],
        }
    }

    /// Returns the same factors for the free motion, per state of the block.
    pub fn free(&self, row: &[f64], h: f64) -> [[f64; 2]; 2] {
        match self {
            BlockOnStep::Turning(_) => [[row[0], row[1]], [row[1], -row[0]]],
            BlockOnStep::Double(_) => [[row[0], 0.0], [row[1], h * row[0]]],
            BlockOnStep::FreeBody(rate) => [[row[0], -rate * h * row[0]], [row[1], h * row[0]]],
            BlockOnStep::Single(_) => [[row[0], 0.0], [0.0, 0.0]],
        }
    }

    /// Returns the factors on `first` and `second` that give the entries `a` and `b` of the flow of
    /// this block (see [`crate::flow::row`]).
    pub fn entries(&self, h: f64) -> [f64; 2] {
        match self {
            BlockOnStep::Double(_) | BlockOnStep::FreeBody(_) => [1.0, h],
            BlockOnStep::Turning(_) | BlockOnStep::Single(_) => [1.0, 1.0],
        }
    }

    /// Returns the eigenvalue of the block, 1/s.
    pub fn rate(&self) -> c64 {
        match *self {
            BlockOnStep::Turning(rate) => rate,
            BlockOnStep::Double(rate) | BlockOnStep::FreeBody(rate) | BlockOnStep::Single(rate) => {
                c64::new(rate, 0.0)
            }
        }
    }
}

impl StepResponse {
    /// Computes the responses of all blocks on a step of one length.
    pub fn of_all(block: &BlockDiagonal, basis: &BasisFunctions, length_s: f64) -> Vec<Self> {
        parts(block)
            .map(|(_, part)| Self::of_part(&part, basis, length_s))
            .collect()
    }

    /// Computes the responses of one block.
    pub fn of_part(part: &BlockOnStep, basis: &BasisFunctions, length_s: f64) -> Self {
        let w = Portable::new();
        let mut responses = Self::default();
        let factors = factored(w, &[*part], basis, length_s);
        responses.solve(w, part, basis, length_s, (&factors, 0));
        responses
    }

    /// Solves one block for one step length, given the factors of up to eight blocks and the index
    /// of the block among them.
    #[inline(always)]
    pub fn solve<W: Simd>(
        &mut self,
        w: W,
        part: &BlockOnStep,
        basis: &BasisFunctions,
        h: f64,
        (factors, index): (&[TridiagonalFactors], usize),
    ) {
        let factors = &factors[..terms(part, basis, h)];
        let count = factors.len();
        self.first.clear();
        self.first.resize(count, F64x8::ZERO);
        self.second.clear();
        self.second.resize(count, F64x8::ZERO);
        integrate(w, &basis.series, &mut self.first);
        self.first[0].0[NODES] = 1.0;
        self.sweep(w, factors, index);
        if matches!(part, BlockOnStep::Double(_)) {
            let first_response = std::mem::take(&mut self.first);
            let mut driven = std::mem::take(&mut self.second);
            integrate(w, &first_response, &mut driven);
            self.first = driven;
            self.second = vec![F64x8::ZERO; count];
            self.sweep(w, factors, index);
            self.second = std::mem::replace(&mut self.first, first_response);
        }
        if matches!(part, BlockOnStep::FreeBody(_)) {
            // The sweep of a real rate leaves zeros.
            integrate(w, &self.first, &mut self.second);
        }
    }

    /// Forward and back substitution for all eight right sides.
    #[inline(always)]
    pub(super) fn sweep<W: Simd>(&mut self, w: W, factors: &[TridiagonalFactors], index: usize) {
        let count = factors.len();
        let at = |part: &[F64x8; 2]| [part[0].0[index], part[1].0[index]];
        let (re, im) = (&mut self.first[..count], &mut self.second[..count]);
        let (mut last_re, mut last_im) = (w.load(&re[0]), w.load(&im[0]));
        for n in 1..count {
            let [before_re, before_im] = at(&factors[n].before);
            let (c, s, t) = (w.splat(before_re), w.splat(before_im), w.splat(-before_im));
            let next_re = w.fma(t, last_im, w.fma(c, last_re, w.load(&re[n])));
            let next_im = w.fma(s, last_re, w.fma(c, last_im, w.load(&im[n])));
            (re[n], im[n]) = (w.store(next_re), w.store(next_im));
            (last_re, last_im) = (next_re, next_im);
        }
        (last_re, last_im) = (w.zero(), w.zero());
        for n in (0..count).rev() {
            let ([after_re, after_im], [inverse_re, inverse_im]) =
                (at(&factors[n].after), at(&factors[n].inverse));
            let (c, s, t) = (w.splat(-after_re), w.splat(-after_im), w.splat(after_im));
            let row_re = w.fma(t, last_im, w.fma(c, last_re, w.load(&re[n])));
            let row_im = w.fma(s, last_re, w.fma(c, last_im, w.load(&im[n])));
            let (c, s, t) = (
                w.splat(inverse_re),
                w.splat(inverse_im),
                w.splat(-inverse_im),
            );
            last_re = w.fma(t, row_im, w.mul(c, row_re));
            last_im = w.fma(s, row_re, w.mul(c, row_im));
            (re[n], im[n]) = (w.store(last_re), w.store(last_im));
        }
    }
}

/// Returns `S g`, truncated to the available length.
#[inline(always)]
pub(super) fn integrate<W: Simd>(w: W, series: &[F64x8], out: &mut [F64x8]) {
    let add = |w: W, lane: &mut F64x8, factor: f64, g: W::Register| {
        *lane = w.store(w.fma(w.splat(factor), g, w.load(lane)))
    };
    for (n, lane) in series.iter().enumerate() {
        let g = w.load(lane);
        if n == 0 {
            add(w, &mut out[0], 0.5, g);
        } else {
            add(w, &mut out[n - 1], -below(n), g);
        }
        if n + 1 < out.len() {
            add(w, &mut out[n + 1], below(n), g);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::force_response::basis::{SMOOTH_BASIS, legendre};

    /// Computes `int_0^x e^{z (x - s)} phi(s) ds` by composite quadrature in `s = x r^2`, in which
    /// onset functions are smooth.
    fn quadrature(z: c64, basis: &BasisFunctions, j: usize, x: f64) -> c64 {
        let (gauss, panels) = (&*SMOOTH_BASIS, 60);
        let mut sum = c64::new(0.0, 0.0);
        for p in 0..panels {
            for i in 0..NODES {
                let r = (f64::from(p) + gauss.positions[i]) / f64::from(panels);
                let s = x * r * r;
                sum += (z * (x - s)).exp()
                    * (basis.at(s)[j] * gauss.weights.0[i] * 2.0 * r * x / f64::from(panels));
            }
        }
        sum
    }

    /// Returns the largest error of the responses, and of their imaginary parts, which start like a
    /// displacement.
    fn worst(basis: &BasisFunctions, z: c64) -> [f64; 2] {
        let mut responses = StepResponse::default();
        let (w, part) = (Portable::new(), BlockOnStep::Turning(z));
        responses.solve(w, &part, basis, 1.0, (&factored(w, &[part], basis, 1.0), 0));
        let mut worst: [f64; 2] = [0.0; 2];
        for x in [basis.positions[1], 0.4, 1.0] {
            let powers = legendre(x, responses.first.len());
            let at = |j: usize| -> c64 {
                let rows = responses.first.iter().zip(&responses.second).zip(&powers);
                rows.map(|((re, im), p)| c64::new(re.0[j] * p, im.0[j] * p))
                    .sum()
            };
            for j in 0..NODES {
                let error = at(j) - quadrature(z, basis, j, x);
                worst = [worst[0].max(error.norm()), worst[1].max(error.im.abs())];
            }
            worst[0] = worst[0].max((at(NODES) - (z * x).exp()).norm());
        }
        worst
    }

    #[test]
    fn agree_with_quadrature_for_small_and_large_rates() {
        let onset = BasisFunctions::onset(1.5).unwrap();
        let mut all: Vec<(c64, f64, [f64; 2])> = Vec::new();
        for z in [
            (-1e-9, 1e-7),
            (-0.3, 1.0),
            (-0.01, 6.0),
            (-2.0, 40.0),
            (-30.0, 0.0),
            (0.0, 0.0),
        ]
        .map(|(re, im)| c64::new(re, im))
        {
            all.push((z, worst(&SMOOTH_BASIS, z)[0], worst(&onset, z)));
        }
        // Onset functions are truncated; the effect on a displacement is smaller by another factor
        // of the number of terms.
        let within = |z: &c64, smooth: &f64, onset: &[f64; 2]| {
            *smooth < 1e-14 && onset[0] < 1e-7 && onset[1] <= 1e-9 * z.norm()
        };
        assert!(
            all.iter()
                .all(|(z, smooth, onset)| within(z, smooth, onset)),
            "rate, smooth, onset: {all:?}"
        );
    }

    #[test]
    fn response_of_a_double_rate_matches_its_closed_form() {
        let (rate, h) = (-3.0, 0.5);
        let mut responses = StepResponse::default();
        let (w, part) = (Portable::new(), BlockOnStep::Double(rate));
        responses.solve(
            w,
            &part,
            &SMOOTH_BASIS,
            h,
            (
                &factored(w, &[BlockOnStep::Single(-1.0), part], &SMOOTH_BASIS, h),
                1,
            ),
        );
        // second in lane 7: x e^{z x}
        let powers = legendre(0.7, responses.second.len());
        let second: f64 = responses
            .second
            .iter()
            .zip(&powers)
            .map(|(lane, p)| lane.0[NODES] * p)
            .sum();
        assert!((second - 0.7 * (rate * h * 0.7_f64).exp()).abs() < 1e-15);
    }

    /// Lane 7: `(e^{z x} - 1) / z`, and `x` without losses.
    #[test]
    fn displacement_of_a_free_body_matches_its_closed_form() {
        let h = 0.5;
        for (rate, wanted) in [
            (-3.0, (-1.5 * 0.7_f64).exp_m1() / -1.5),
            (-1e-9, 0.7 - 0.5e-9 * 0.5 * 0.7 * 0.7),
            (0.0, 0.7),
        ] {
            let part = BlockOnStep::FreeBody(rate);
            let responses = StepResponse::of_part(&part, &SMOOTH_BASIS, h);
            let powers = legendre(0.7, responses.second.len());
            let series = responses.second.iter().zip(&powers);
            let second: f64 = series.map(|(lane, p)| lane.0[NODES] * p).sum();
            assert!((second - wanted).abs() < 1e-15, "{rate}: {second} {wanted}");
        }
    }
}
