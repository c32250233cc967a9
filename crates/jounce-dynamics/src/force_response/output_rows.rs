//! Output rows of the state on a contact step: their response to the free motion and to the seven
//! nodal forces.

use super::basis::{BasisFunctions, NODES};
use super::duhamel::DuhamelIntegrals;
use super::factors::{factored_rows, terms};
use super::fast_decay::{FastDecay, StateDecay};
use super::step_response::{BlockOnStep, StepResponse};
use crate::flow::layout::StateLayout;
use jounce_model::plant::{BlockDiagonal, BlockPair};
use jounce_simd::{F64x8, LANES, Simd, Task};

/// Row on a step: `value_i = sum_k columns_k[i] y_k + sum_j push_j[i] f_j`.
#[derive(Debug, Clone, Default)]
pub struct OutputRow {
    /// One vector per state in column order; empty for an integrated row.
    pub columns: Vec<F64x8>,
    /// One vector per force node.
    pub push: [F64x8; NODES],
}

/// Evaluation of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowReading {
    /// Values at the nodes and at the end of the step.
    Pointwise,
    /// Integrated over the step against each function of the basis; the eighth lane is 0.
    Integral,
}

/// Requested row on a step.
#[derive(Debug, Clone)]
pub struct RowRequest {
    /// Row in block coordinates.
    pub row: Vec<f64>,
    /// Evaluation of the row.
    pub reading: RowReading,
}

impl RowRequest {
    /// Returns the number of columns that the row needs.
    fn columns(&self, block: &BlockDiagonal) -> usize {
        if self.reading == RowReading::Pointwise {
            block.len()
        } else {
            0
        }
    }
}

/// All rows on a step, and the integrals of its nodal forces.
#[derive(Debug, Clone, Default)]
pub struct OutputRows {
    /// Rows in the order of the requests.
    pub rows: Vec<OutputRow>,
    /// Legendre series of the rows in time under a unit force of each node, one vector per
    /// coefficient, without the decays.
    pub series: Vec<Vec<F64x8>>,
    /// Fast decays, which the series lack.
    pub decays: Vec<StateDecay>,
    /// Integrals of the reader's functions from the start of the step (see [`super::duhamel`]).
    pub from_start: DuhamelIntegrals,
    /// Integrals of the basis of the force towards its end.
    pub towards_end: DuhamelIntegrals,
}

impl OutputRows {
    /// Creates rows and integrals of value zero, without series.
    fn empty(rows: &[RowRequest], block: &BlockDiagonal, layout: &StateLayout) -> Self {
        Self {
            rows: rows
                .iter()
                .map(|row| OutputRow {
                    columns: vec![F64x8::ZERO; row.columns(block)],
                    push: [F64x8::ZERO; NODES],
                })
                .collect(),
            from_start: vec![[F64x8::ZERO; NODES]; layout.lanes()],
            towards_end: vec![[F64x8::ZERO; NODES]; layout.lanes()],
            series: Vec::new(),
            decays: Vec::new(),
        }
    }

    /// Adds the series of each row, evaluated with the Legendre polynomials at the nodes or with
    /// their moments, to its response to the nodal forces.
    #[inline(always)]
    fn evaluate<W: Simd>(
        &mut self,
        w: W,
        rows: &[RowRequest],
        series: Vec<Vec<F64x8>>,
        [powers, moments]: [&[F64x8]; 2],
    ) {
        for ((request, response), series) in rows.iter().zip(&mut self.rows).zip(&series) {
            let at = if request.reading == RowReading::Pointwise {
                powers
            } else {
                moments
            };
            add_summed(w, at, series, &mut response.push);
        }
        self.series = series;
    }

    /// Adds the effect of a block through its two responses.
    #[inline(always)]
    fn add_block<W: Simd>(
        &mut self,
        w: W,
        task: &OutputRowsTask,
        (first, part): (usize, &BlockOnStep),
        responses: &StepResponse,
        [powers, moments]: [&[F64x8]; 2],
        series: &mut [Vec<F64x8>],
    ) {
        let (h, layout) = (task.length_s, task.layout);
        let states = first..first + part.states();
        let free = free_motion(w, responses, powers);
        for ((request, response), series) in task.rows.iter().zip(&mut self.rows).zip(series) {
            let row = &request.row[states.clone()];
            let mut n_terms = task.reader.series.len();
            if request.reading == RowReading::Pointwise {
                n_terms = responses.first.len();
                for (state, [f, g]) in states.clone().zip(part.free(row, h)) {
                    response.columns[layout.column(state)] =
                        w.store(w.fma(w.splat(f), free[0], w.mul(w.splat(g), free[1])));
                }
            }
            let factors = part.forced(row, &task.force[states.clone()], h);
            add_series(w, series, responses, factors, n_terms);
        }
        let mean = free_motion(w, responses, moments).map(|sum| w.store(sum));
        let end = ends(w, responses).map(|sum| w.store(sum));
        for (state, factor) in states.zip(part.entries(h)) {
            let motion = [&mean[state - first], &end[state - first]];
            self.set_integrals(layout.locate(state), [factor, h * factor], motion);
        }
    }

    /// Sets the integrals of one state: mean and end of its motion under each nodal force, times
    /// factors.
    #[inline(always)]
    pub(super) fn set_integrals(
        &mut self,
        (lane, lane_index): (usize, usize),
        factors: [f64; 2],
        [mean, end]: [&F64x8; 2],
    ) {
        for j in 0..NODES {
            self.from_start[lane][j].0[lane_index] = factors[0] * mean.0[j];
            self.towards_end[lane][j].0[lane_index] = factors[1] * end.0[j];
        }
    }
}

/// Computation of output rows.
#[derive(Debug, Clone, Copy)]
pub struct OutputRowsTask<'a> {
    /// Blocks of the plant.
    pub block: &'a BlockDiagonal,
    /// Layout of the state.
    pub layout: &'a StateLayout,
    /// Basis of the force on the step.
    pub basis: &'a BasisFunctions,
    /// Basis with the nodes, or the functions, at which the rows are evaluated.
    pub reader: &'a BasisFunctions,
    /// Column of a unit force, block coordinates.
    pub force: &'a [f64],
    /// Requested rows.
    pub rows: &'a [RowRequest],
    /// Length, s.
    pub length_s: f64,
}

/// Returns the blocks with the index of their first state.
pub fn parts(block: &BlockDiagonal) -> impl Iterator<Item = (usize, BlockOnStep)> + '_ {
    let pairs = block
        .pairs
        .iter()
        .enumerate()
        .map(|(k, pair): (usize, &BlockPair)| (2 * k, BlockOnStep::of(pair)));
    let first = 2 * block.pairs.len();
    pairs.chain(
        block
            .reals
            .iter()
            .enumerate()
            .map(move |(k, rate)| (first + k, BlockOnStep::Single(*rate))),
    )
}

impl Task for OutputRowsTask<'_> {
    type Output = OutputRows;

    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> OutputRows {
        let OutputRowsTask {
            block,
            layout,
            basis,
            reader,
            rows,
            length_s: h,
            ..
        } = self;
        let task = self;
        let is_fast = |part: &BlockOnStep| FastDecay::applies(part, [basis, reader], h);
        let count_of = |parts: &[BlockOnStep]| {
            let slow = parts.iter().filter(|part| !is_fast(part));
            let counts = slow.map(|part| terms(part, basis, h));
            counts.max().unwrap_or(basis.series.len())
        };
        let (firsts, all): (Vec<usize>, Vec<BlockOnStep>) = parts(block).unzip();
        let count = count_of(&all);
        let powers = legendre_lanes(w, reader, count);
        let moments: Vec<F64x8> = (reader.series.iter().enumerate())
            .map(|(a, lane)| w.store(w.mul(w.splat(h / (2 * a + 1) as f64), w.load(lane))))
            .collect();
        let at: [&[F64x8]; 2] = [&powers, &moments];
        let mut series = vec![vec![F64x8::ZERO; count]; rows.len()];
        let mut out = OutputRows::empty(rows, block, layout);
        let mut responses = StepResponse::default();
        let mut factors = Vec::new();
        for (index, (first, part)) in firsts.iter().zip(&all).enumerate() {
            let lane_index = index % LANES;
            if lane_index == 0 {
                let group = &all[index..all.len().min(index + LANES)];
                factors = factored_rows(w, group, h, count_of(group));
            }
            if is_fast(part) {
                let decay = FastDecay::new(part, basis, h);
                out.add_fast_decay(w, &task, (*first, part), &decay, &mut series);
                continue;
            }
            responses.solve(w, part, basis, h, (&factors, lane_index));
            out.add_block(w, &task, (*first, part), &responses, at, &mut series);
        }
        out.evaluate(w, rows, series, at);
        out
    }
}

/// Adds the motion of a block, its two responses times factors, to the first terms of a series.
#[inline(always)]
pub(super) fn add_series<W: Simd>(
    w: W,
    series: &mut [F64x8],
    responses: &StepResponse,
    [f, g]: [f64; 2],
    n_terms: usize,
) {
    for ((sum, first), second) in series
        .iter_mut()
        .zip(&responses.first)
        .zip(&responses.second)
        .take(n_terms)
    {
        *sum = w.store(w.fma(
            w.splat(f),
            w.load(first),
            w.fma(w.splat(g), w.load(second), w.load(sum)),
        ));
    }
}

/// Adds series, evaluated at eight points (vectors of factors), to one vector per force node.
#[inline(always)]
fn add_summed<W: Simd>(w: W, at: &[F64x8], series: &[F64x8], push: &mut [F64x8; NODES]) {
    let mut sums = [w.zero(); LANES];
    for (row, lane) in at.iter().zip(series) {
        let lane = w.load(lane);
        for (sum, factor) in sums.iter_mut().zip(&row.0) {
            *sum = w.fma(w.splat(*factor), lane, *sum);
        }
    }
    for (i, sum) in sums.into_iter().enumerate() {
        let by_force = w.store(sum);
        (0..NODES).for_each(|j| push[j].0[i] += by_force.0[j]);
    }
}

/// Returns `P_a` at the nodes and the end of a basis, one vector per `a`.
#[inline(always)]
fn legendre_lanes<W: Simd>(w: W, basis: &BasisFunctions, count: usize) -> Vec<F64x8> {
    let s = w.fma(w.splat(2.0), w.load(&F64x8(basis.positions)), w.splat(-1.0));
    let mut powers = vec![w.store(w.splat(1.0)); count.max(2)];
    let (mut before, mut now) = (w.splat(1.0), s);
    powers[1] = w.store(s);
    for n in 1..count.saturating_sub(1) {
        let n_f = n as f64;
        let (up, back) = ((2.0 * n_f + 1.0) / (n_f + 1.0), -n_f / (n_f + 1.0));
        let next = w.fma(w.mul(w.splat(up), s), now, w.mul(w.splat(back), before));
        (before, now) = (now, next);
        powers[n + 1] = w.store(next);
    }
    powers
}

/// Returns the free motion of both responses, summed against vectors.
#[inline(always)]
fn free_motion<W: Simd>(w: W, responses: &StepResponse, lanes: &[F64x8]) -> [W::Register; 2] {
    let mut sums = [w.zero(); 2];
    for ((lane, first), second) in lanes.iter().zip(&responses.first).zip(&responses.second) {
        let lane = w.load(lane);
        sums[0] = w.fma(w.splat(first.0[NODES]), lane, sums[0]);
        sums[1] = w.fma(w.splat(second.0[NODES]), lane, sums[1]);
    }
    sums
}

/// Returns both responses at the end of the step, where every Legendre polynomial is 1.
#[inline(always)]
pub(super) fn ends<W: Simd>(w: W, responses: &StepResponse) -> [W::Register; 2] {
    let mut sums = [w.zero(); 2];
    for (first, second) in responses.first.iter().zip(&responses.second) {
        sums = [
            w.add(sums[0], w.load(first)),
            w.add(sums[1], w.load(second)),
        ];
    }
    sums
}
