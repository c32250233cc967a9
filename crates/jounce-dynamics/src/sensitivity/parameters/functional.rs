//! Linear functionals of the motion on a step.

use crate::force_response::basis::NODES;
use crate::force_response::output_rows::parts;
use crate::force_response::step_response::StepResponse;
use jounce_model::plant::BlockDiagonal;

/// Linear functional of the motion on a step: weights of the coefficients of an output row.
pub struct Functional<'a> {
    pub block: &'a BlockDiagonal,
    pub row: &'a [f64],
    pub weights: &'a [f64],
    pub length_s: f64,
}

impl Functional<'_> {
    /// Returns its value for a unit of each state at the start.
    pub fn of_start(&self, free: &[StepResponse]) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.row.len());
        for ((first, part), response) in parts(self.block).zip(free) {
            let row = &self.row[first..first + part.states()];
            let [one, two] = self.sums(response, NODES);
            let factors = part
                .free(row, self.length_s)
                .into_iter()
                .take(part.states());
            values.extend(factors.map(|[f, g]| f * one + g * two));
        }
        values
    }

    /// Returns its value for a unit of each nodal force on a column.
    pub fn of_force(&self, responses: &[StepResponse], column: &[f64]) -> [f64; NODES] {
        let mut values = [0.0; NODES];
        for ((first, part), response) in parts(self.block).zip(responses) {
            let states = first..first + part.states();
            let [f, g] = part.forced(&self.row[states.clone()], &column[states], self.length_s);
            for (j, value) in values.iter_mut().enumerate() {
                let [one, two] = self.sums(response, j);
                *value += f * one + g * two;
            }
        }
        values
    }

    /// Returns the weighted sums of one lane of both series of a response.
    fn sums(&self, response: &StepResponse, lane: usize) -> [f64; 2] {
        let rows = response
            .first
            .iter()
            .zip(&response.second)
            .zip(self.weights);
        rows.fold([0.0; 2], |[first, second], ((one, two), weight)| {
            [first + weight * one.0[lane], second + weight * two.0[lane]]
        })
    }
}
