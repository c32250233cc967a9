//! Strain of the patches on the branches of a response.

use super::StoredResponse;
use crate::error::Error;
use crate::live::LiveAnalysis;
use jounce_analysis::{Branch, BranchPoint, Model};
use jounce_control::Control;
use jounce_orbits::{OrbitQuantity, ParametricModel, Shooting};
use rayon::prelude::*;

/// Relative tolerance of the integration.
const TOLERANCE: f64 = 1e-9;

impl LiveAnalysis {
    /// Returns the largest strain of any patch over the period, for each point of each branch of a
    /// stored response; NaN where the orbit cannot be integrated.
    ///
    /// # Errors
    /// [`Error::Option`] for a response that is no longer stored, [`Error::Analysis`] for a design
    /// without a model.
    pub fn strain(&self, response: u64, control: &Control) -> Result<Vec<Vec<f64>>, Error> {
        let stored = self.stored_response(response)?;
        let base = self.model(&stored.spec, control)?;
        let branches = stored.branches.par_iter();
        Ok(branches
            .map(|branch| of_branch(&stored, &base, branch))
            .collect())
    }
}

fn of_branch(stored: &StoredResponse, base: &Model, branch: &Branch) -> Vec<f64> {
    let parameter = stored.parameter(base);
    let shooting = Shooting::new(&parameter, &base.kernel, branch.period_cycles, TOLERANCE);
    let strain = |point: &BranchPoint| {
        let kernel = parameter.at(point.parameter).ok()?.kernel;
        let patches = kernel.plant.system.modes.patch.len();
        let period = shooting.integrated(kernel, point.orbit.start()).ok()?;
        let peaks = (0..patches).map(|patch| OrbitQuantity::Strain(patch).of(&period));
        Some(peaks.fold(0.0, f64::max))
    };
    let points = branch.points.par_iter();
    points
        .map(|point| strain(point).unwrap_or(f64::NAN))
        .collect()
}
