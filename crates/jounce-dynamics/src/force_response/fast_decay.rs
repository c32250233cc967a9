//! Response of a fast real decay to the force on a step: a polynomial and a decay.
//!
//! On a step scaled to `x` in `[0, 1]`, `y' = z y + g(x)` with `z = h lambda` and a polynomial `g` of
//! degree `n` has the solution from rest
//!
//! ```text
//! y(x) = p(x) - p(0) e^{z x},   p = (p' - g) / z = -(g + g' / z + g'' / z^2 + ..) / z,
//! ```
//!
//! a finite sum: the state follows the force (quasi-static), after a decay from the start. By
//! Markov's inequality `|g'| <= 2 n^2 max |g|` on `[0, 1]`. Where `|z| >= 4 n^2`, each term is at most
//! half of the one before, and the sum has no cancellation. Likewise
//!
//! ```text
//! int_0^1 g e^{z x} dx = q(1) e^z - q(0),   q = (g - q') / z.
//! ```
//!
//! A Legendre series of the decay would need a number of terms that grows with the root of `z`.

use super::basis::{BasisFunctions, NODES};
use super::output_rows::{OutputRows, OutputRowsTask, RowReading, add_series, ends};
use super::step_response::{BlockOnStep, StepResponse};
use jounce_simd::{F64x8, Simd};

/// Response of one fast decay, in the scale of [`super::step_response::StepResponse`]. Lanes 0 to 6
/// belong to the nodal forces, lane 7 to the free motion.
#[derive(Debug, Clone)]
pub struct FastDecay {
    z: f64,
    /// Legendre coefficients of `p`, row by row.
    pub series: Vec<F64x8>,
    /// `p(0)`.
    pub start: F64x8,
}

/// Fast decay of a state on a step: under the nodal forces the state is a polynomial from its start
/// value, and a decay of the opposite value.
#[derive(Debug, Clone)]
pub struct StateDecay {
    /// State in block order.
    pub state: usize,
    /// Start value of the polynomial per nodal force.
    pub start: F64x8,
}

impl FastDecay {
    /// True where a block decays so fast on a step that its response is split.
    pub fn applies(part: &BlockOnStep, [basis, reader]: [&BasisFunctions; 2], h: f64) -> bool {
        let degree = basis.series.len().max(reader.series.len()) - 1;
        let is_single = matches!(part, BlockOnStep::Single(_));
        is_single && -h * part.rate().re >= 4.0 * (degree * degree) as f64
    }

    /// Computes the response to the functions of a basis.
    pub fn new(part: &BlockOnStep, basis: &BasisFunctions, h: f64) -> Self {
        let z = h * part.rate().re;
        let series = following(&basis.series, z);
        let start = at_start(&series);
        Self { z, series, start }
    }

    /// Returns the factors of `e^{z x}` in the responses.
    pub fn amplitudes(&self) -> F64x8 {
        F64x8(std::array::from_fn(|j| {
            if j == NODES { 1.0 } else { -self.start.0[j] }
        }))
    }

    /// Returns `e^{z x}` at the nodes and the end of a basis.
    pub fn values(&self, reader: &BasisFunctions) -> F64x8 {
        F64x8(reader.positions.map(|x| (self.z * x).exp()))
    }

    /// Returns `h int_0^1 phi e^{z x} dx` for each function of a basis.
    pub fn moments(&self, reader: &BasisFunctions, h: f64) -> F64x8 {
        let series = following(&reader.series, -self.z);
        let (start, end) = (at_start(&series), sum(&series, |_| 1.0));
        let decayed = self.z.exp();
        F64x8(std::array::from_fn(|j| {
            h * (end.0[j] * decayed - start.0[j])
        }))
    }
}

impl OutputRows {
    /// Adds the effect of a block whose response is a polynomial and a decay.
    #[inline(always)]
    pub(super) fn add_fast_decay<W: Simd>(
        &mut self,
        w: W,
        task: &OutputRowsTask,
        (state, part): (usize, &BlockOnStep),
        decay: &FastDecay,
        series: &mut [Vec<F64x8>],
    ) {
        let (h, reader, column) = (task.length_s, task.reader, task.force[state]);
        let (values, moments) = (decay.values(reader), decay.moments(reader, h));
        let (amplitudes, none) = (decay.amplitudes(), vec![F64x8::ZERO; decay.series.len()]);
        let polynomial = StepResponse {
            first: decay.series.clone(),
            second: none,
        };
        for ((request, response), series) in task.rows.iter().zip(&mut self.rows).zip(series) {
            let row = request.row[state];
            let is_pointwise = request.reading == RowReading::Pointwise;
            let (at, n_terms) = if is_pointwise {
                response.columns[task.layout.column(state)] = F64x8::ZERO.add_scaled(row, &values);
                (&values, polynomial.first.len())
            } else {
                (&moments, reader.series.len())
            };
            let factors = part.forced(&[row], &[column], h);
            for (j, push) in response.push.iter_mut().enumerate() {
                *push = push.add_scaled(factors[0] * amplitudes.0[j], at);
            }
            add_series(w, series, &polynomial, factors, n_terms);
        }
        let [polynomial_end, _] = ends(w, &polynomial).map(|sum| w.store(sum));
        let end = polynomial_end.add_scaled(values.0[NODES], &amplitudes);
        self.set_integrals(task.layout.locate(state), [1.0, h], [&moments, &end]);
        self.decays.push(StateDecay {
            state,
            start: F64x8::ZERO.add_scaled(h * column, &decay.start),
        });
    }
}

/// Returns the polynomial `p = (p' - g) / z` for each lane of a Legendre series `g`.
fn following(series: &[F64x8], z: f64) -> Vec<F64x8> {
    let mut solution = vec![F64x8::ZERO; series.len()];
    // Sums of every second coefficient above a row: `p'_k = 2 (2 k + 1) (p_{k+1} + p_{k+3} + ..)`.
    let mut above = [F64x8::ZERO; 2];
    for k in (0..series.len()).rev() {
        let slope = 2.0 * (2 * k + 1) as f64;
        solution[k] = F64x8::ZERO
            .add_scaled(slope / z, &above[(k + 1) % 2])
            .add_scaled(-1.0 / z, &series[k]);
        above[k % 2] = above[k % 2].add_scaled(1.0, &solution[k]);
    }
    solution
}

/// Returns a Legendre series at the start of the step.
fn at_start(series: &[F64x8]) -> F64x8 {
    sum(series, |k| if k % 2 == 0 { 1.0 } else { -1.0 })
}

fn sum(series: &[F64x8], factor: impl Fn(usize) -> f64) -> F64x8 {
    (series.iter().enumerate()).fold(F64x8::ZERO, |sum, (k, lane)| {
        sum.add_scaled(factor(k), lane)
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::force_response::basis::{SMOOTH_BASIS, legendre};
    use crate::force_response::step_response::StepResponse;

    /// The split response against the Legendre series of the complete response.
    #[test]
    fn a_fast_decay_is_the_series_of_its_complete_response() {
        let onset = BasisFunctions::onset(1.5).unwrap();
        for (basis, z) in [
            (&*SMOOTH_BASIS, 150.0),
            (&*SMOOTH_BASIS, 1e4),
            (&onset, 2e4),
        ] {
            let part = BlockOnStep::Single(-z);
            assert!(FastDecay::applies(&part, [basis, basis], 1.0));
            let (fast, all) = (
                FastDecay::new(&part, basis, 1.0),
                StepResponse::of_part(&part, basis, 1.0),
            );
            let amplitudes = fast.amplitudes();
            for x in [0.0, 1e-4, 1e-2, 0.3, 1.0] {
                let powers = legendre(x, all.first.len());
                let at = |series: &[F64x8], j: usize| -> f64 {
                    series.iter().zip(&powers).map(|(a, p)| a.0[j] * p).sum()
                };
                for j in 0..=NODES {
                    let split = at(&fast.series, j) + amplitudes.0[j] * (-z * x).exp();
                    // The series of the onset functions is the same in both.
                    let scale = if j == NODES { 1.0 } else { 1.0 / z };
                    assert!(
                        (split - at(&all.first, j)).abs() < 1e-12 * scale,
                        "z {z} x {x} function {j}: {split:e} {:e}",
                        at(&all.first, j)
                    );
                }
            }
        }
    }

    /// `int e^{-z x} dx` and `int x e^{-z x} dx`, in closed form.
    #[test]
    fn moments_of_a_fast_decay_match_their_closed_form() {
        let (z, basis) = (200.0_f64, &*SMOOTH_BASIS);
        let fast = FastDecay::new(&BlockOnStep::Single(-z), basis, 1.0);
        let moments = fast.moments(basis, 1.0);
        let of = |weights: &dyn Fn(f64) -> f64| -> f64 {
            (0..NODES)
                .map(|j| weights(basis.positions[j]) * moments.0[j])
                .sum()
        };
        assert!((of(&|_| 1.0) * z - 1.0).abs() < 1e-12);
        assert!((of(&|x| x) * z * z - 1.0).abs() < 1e-10);
    }
}
