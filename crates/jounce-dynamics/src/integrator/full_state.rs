//! State of an integration at its current time, with the part that the signals force.

use super::Integrator;
use jounce_simd::F64x8;

/// State in all its coordinates.
pub(crate) struct FullState {
    /// Block coordinates in vectors.
    pub lanes: Vec<F64x8>,
    /// Block coordinates.
    pub block: Vec<f64>,
    /// Physical state `(q, q', V, i)`.
    pub physical: Vec<f64>,
}

impl Integrator<'_> {
    /// Returns the current state.
    pub(crate) fn full_state(&self) -> FullState {
        let lanes = self.excitation.full_lanes(&self.y);
        let block = self.layout.unpack(&lanes);
        FullState {
            physical: self.kernel.plant.to_physical(&block, self.time_s),
            lanes,
            block,
        }
    }
}
