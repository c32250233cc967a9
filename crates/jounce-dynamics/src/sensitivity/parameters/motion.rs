//! Motion on a step as Legendre series in time, and the motion that a change of the parameters
//! forces on it.
//!
//! With the state `y` on a step, a parameter forces the motion
//!
//! ```text
//! p' = A p + dA y + db f + dg,   p = 0 at the start of the step
//! ```
//!
//! in which the contact force `f` is that of the unchanged plant. All terms on the right are series
//! whose coefficients are known exactly, so that each block is one tridiagonal solve as in
//! [`crate::force_response::step_response`].

use super::group::ParameterGroup;
use crate::force_response::basis::{NODES, SMOOTH_BASIS};
use crate::force_response::factors::factored_rows;
use crate::force_response::output_rows::parts;
use crate::force_response::step_response::{BlockOnStep, StepResponse};
use crate::kernel::{ForceBasis, Kernel};
use crate::record::trajectory::TrajectorySegment;
use jounce_linalg::c64;
use jounce_simd::{F64x8, LANES, Simd};
use std::collections::HashMap;
use std::sync::Arc;

/// Responses of the blocks on steps of a kernel, by length and by port where the basis of the force
/// is that of an onset.
pub type Responses = HashMap<(u64, Option<usize>), Arc<Vec<StepResponse>>>;

/// Motion on a step.
pub struct StepMotion {
    /// Length, s.
    pub length_s: f64,
    /// Number of coefficients.
    pub terms: usize,
    /// Coefficients of each state without the steady part.
    pub states: Vec<Vec<f64>>,
    /// Free responses of the blocks.
    pub free: Arc<Vec<StepResponse>>,
    /// Ports with a force, with the responses to its nodal values and its coefficients.
    pub forces: Vec<(usize, Arc<Vec<StepResponse>>, Vec<f64>)>,
    /// Coefficients of `e^{i w t}` of each tone.
    pub tones: Vec<Vec<c64>>,
}

/// Returns the responses on a step, from those known.
fn responses(
    known: &mut Responses,
    kernel: &Kernel,
    length_s: f64,
    onset: Option<usize>,
) -> Arc<Vec<StepResponse>> {
    let make = || {
        let basis = match onset {
            Some(port) => kernel.basis(port, ForceBasis::Onset),
            None => &SMOOTH_BASIS,
        };
        Arc::new(StepResponse::of_all(
            &kernel.plant.diagonal.block,
            basis,
            length_s,
        ))
    };
    Arc::clone(
        known
            .entry((length_s.to_bits(), onset))
            .or_insert_with(make),
    )
}

impl StepMotion {
    /// Returns the motion on a recorded step.
    pub fn of(kernel: &Kernel, segment: &TrajectorySegment, known: &mut Responses) -> Self {
        let (block, h) = (&kernel.plant.diagonal.block, segment.length_s);
        let free = responses(known, kernel, h, None);
        let mut forces = Vec::with_capacity(segment.forces.len());
        for force in &segment.forces {
            let basis = kernel.basis(force.port, force.shape);
            let onset = (!basis.is_mirrored()).then_some(force.port);
            let nodal =
                |lane: &F64x8| -> f64 { (0..NODES).map(|j| force.nodal_n[j] * lane.0[j]).sum() };
            let series = basis.series.iter().map(nodal).collect();
            forces.push((force.port, responses(known, kernel, h, onset), series));
        }
        let of_forces = forces.iter().flat_map(|(_, responses, _)| responses.iter());
        let longest = free
            .iter()
            .chain(of_forces)
            .map(|response| response.first.len())
            .max();
        let tones = tones(kernel, segment);
        let of_tones = tones.iter().map(Vec::len).max();
        let terms = longest.max(of_tones).unwrap_or(1);
        let mut states = forced(kernel, segment, terms);
        for ((first, part), response) in parts(block).zip(free.iter()) {
            let own = &segment.state[first..first + part.states()];
            for s in 0..part.states() {
                let unit: [f64; 2] = std::array::from_fn(|i| f64::from(u8::from(i == s)));
                for (value, [f, g]) in own.iter().zip(part.free(&unit, h)) {
                    add_lane(
                        &mut states[first + s],
                        response,
                        NODES,
                        [f * value, g * value],
                    );
                }
            }
        }
        for (force, (port, responses, _)) in segment.forces.iter().zip(&forces) {
            let column = &kernel.plant.ports[*port].force;
            for ((first, part), response) in parts(block).zip(responses.iter()) {
                for s in 0..part.states() {
                    let unit: [f64; 2] = std::array::from_fn(|i| f64::from(u8::from(i == s)));
                    let [f, g] = part.forced(&unit, &column[first..first + part.states()], h);
                    for (j, value) in force.nodal_n.iter().enumerate() {
                        add_lane(&mut states[first + s], response, j, [f * value, g * value]);
                    }
                }
            }
        }
        Self {
            length_s: h,
            terms,
            states,
            free,
            forces,
            tones,
        }
    }
}

/// Adds multiples of one lane of both series of a response.
fn add_lane(sum: &mut [f64], response: &StepResponse, lane: usize, [first, second]: [f64; 2]) {
    let rows = response.first.iter().zip(&response.second);
    for (sum, (one, two)) in sum.iter_mut().zip(rows) {
        *sum += first * one.0[lane] + second * two.0[lane];
    }
}

/// Returns the coefficients of `e^{i w t}` of each tone on a step.
fn tones(kernel: &Kernel, segment: &TrajectorySegment) -> Vec<Vec<c64>> {
    let of = |tone: &jounce_model::plant::Tone| {
        let w = tone.angular_frequency_rad_s;
        let part = BlockOnStep::Turning(c64::new(0.0, w));
        let response = StepResponse::of_part(&part, &SMOOTH_BASIS, segment.length_s);
        let turn = c64::cis(w * segment.start_s);
        let rows = response.first.iter().zip(&response.second);
        rows.map(|(re, im)| turn * c64::new(re.0[NODES], im.0[NODES]))
            .collect()
    };
    kernel.plant.tones.iter().map(of).collect()
}

/// Returns the coefficients of the motion under constant drives: a polynomial of low degree.
fn forced(kernel: &Kernel, segment: &TrajectorySegment, terms: usize) -> Vec<Vec<f64>> {
    let n = kernel.plant.len();
    let mut states = vec![vec![0.0; terms]; n];
    if segment.sizes.is_empty() {
        return states;
    }
    for (j, position) in SMOOTH_BASIS.positions.iter().enumerate().take(NODES) {
        let at = kernel
            .plant
            .forced(&segment.sizes, position * segment.length_s);
        for (state, value) in states.iter_mut().zip(at) {
            let rows = state.iter_mut().zip(&SMOOTH_BASIS.series);
            rows.for_each(|(sum, row)| *sum += value * row.0[j]);
        }
    }
    states
}

/// Returns the coefficients of `p` of each state for the parameters of a group.
#[inline(always)]
pub fn forced_by<W: Simd>(
    w: W,
    kernel: &Kernel,
    group: &ParameterGroup<'_>,
    motion: &StepMotion,
) -> Vec<Vec<F64x8>> {
    let (block, h, n) = (
        &kernel.plant.diagonal.block,
        motion.length_s,
        kernel.plant.len(),
    );
    let mut result = Vec::with_capacity(n);
    let all: Vec<(usize, BlockOnStep)> = parts(block).collect();
    // Loops over vectors are written out: see [`Tangents`](crate::sensitivity::tangents::Tangents).
    for some in all.chunks(LANES) {
        let blocks: Vec<BlockOnStep> = some.iter().map(|(_, part)| *part).collect();
        let factors = factored_rows(w, &blocks, h, motion.terms);
        for (index, (first, part)) in some.iter().enumerate() {
            let mut rates = [Vec::new(), Vec::new()];
            for (s, rates) in rates.iter_mut().enumerate().take(part.states()) {
                *rates = right_side(w, group, motion, first + s);
            }
            let states = StepResponse::to(w, part, h, rates, (&factors, index));
            result.extend(states.into_iter().take(part.states()));
        }
    }
    result
}

/// Returns the coefficients of `dA y + db f + dg` of one state.
#[inline(always)]
fn right_side<W: Simd>(
    w: W,
    group: &ParameterGroup<'_>,
    motion: &StepMotion,
    state: usize,
) -> Vec<F64x8> {
    let n = motion.states.len();
    let mut right = vec![F64x8::ZERO; motion.terms];
    for (by, series) in group.rates[state * n..(state + 1) * n]
        .iter()
        .zip(&motion.states)
    {
        if *by != F64x8::ZERO {
            add_series(w, &mut right, by, series);
        }
    }
    for (port, _, series) in &motion.forces {
        let by = &group.ports[*port].columns[0][state];
        if *by != F64x8::ZERO {
            add_series(w, &mut right, by, series);
        }
    }
    right[0] = right[0].add_scaled(1.0, &group.constant[state]);
    right
}

/// Computes `sum += by series`.
#[inline(always)]
pub fn add_series<W: Simd>(w: W, sum: &mut [F64x8], by: &F64x8, series: &[f64]) {
    let by = w.load(by);
    for (sum, value) in sum.iter_mut().zip(series) {
        *sum = w.store(w.fma(w.splat(*value), by, w.load(sum)));
    }
}
