//! Response of one block to any series of its rates.

use super::factors::TridiagonalFactors;
use super::step_response::{BlockOnStep, StepResponse, integrate};
use jounce_simd::{F64x8, Simd};

impl StepResponse {
    /// Returns the series of the states of a block from rest, driven by series of its rates (1/s),
    /// given the factors of up to eight blocks and the index of the block among them. Each lane is
    /// a separate motion; a single rate leaves the second state empty.
    #[inline(always)]
    pub fn to<W: Simd>(
        w: W,
        part: &BlockOnStep,
        h: f64,
        [first, second]: [Vec<F64x8>; 2],
        (factors, index): (&[TridiagonalFactors], usize),
    ) -> [Vec<F64x8>; 2] {
        let mut response = Self {
            first: integrated(w, h, &first, factors.len()),
            second: integrated(w, h, &second, factors.len()),
        };
        if matches!(part, BlockOnStep::Double(_)) {
            // The second state drives the first one.
            let mut driving = Self {
                first: response.second,
                second: vec![F64x8::ZERO; factors.len()],
            };
            driving.sweep(w, factors, index);
            let by_second = integrated(w, h, &driving.first, factors.len());
            for (sum, by) in response.first.iter_mut().zip(&by_second) {
                *sum = w.store(w.add(w.load(sum), w.load(by)));
            }
            response.second = vec![F64x8::ZERO; factors.len()];
            response.sweep(w, factors, index);
            return [response.first, driving.first];
        }
        response.sweep(w, factors, index);
        [response.first, response.second]
    }
}

/// Returns `h S g` with a number of rows.
#[inline(always)]
fn integrated<W: Simd>(w: W, h: f64, series: &[F64x8], count: usize) -> Vec<F64x8> {
    let mut out = vec![F64x8::ZERO; count];
    integrate(w, series, &mut out);
    let h = w.splat(h);
    for lane in &mut out {
        *lane = w.store(w.mul(h, w.load(lane)));
    }
    out
}
