//! What a method of computing orbits gives, beside its residual.

use super::{Orbit, OrbitError, ShootingEvaluation};
use crate::continuation::Problem;

/// A method on the harvesters of one family.
pub trait OrbitMethod: Problem<Error = OrbitError<Self::Fault>> {
    /// Why a harvester cannot be made.
    type Fault: std::error::Error;

    /// Drive cycles of the period.
    fn cycles(&self) -> u32;

    /// The orbit at a converged place; `error` is what Newton left out, relative to the unknown.
    ///
    /// # Errors
    /// Multipliers that cannot be computed.
    fn orbit(&self, local: &Self::Evaluation, error: f64) -> Result<Orbit, Self::Error>;

    /// The period marched on the exact flow from a place: its multipliers, its contacts, its turning points.
    ///
    /// # Errors
    /// A march that fails.
    fn shot<'l>(&self, local: &'l Self::Evaluation) -> Result<&'l ShootingEvaluation, Self::Error>;

    /// The unknown that stands for a state in energy coordinates.
    ///
    /// # Errors
    /// A march that fails.
    fn unknown_of(&self, state: &[f64], parameter: f64) -> Result<Vec<f64>, Self::Error>;

    /// Distance of the answer at a place from the curve of the exact flow, beside the one allowed; `parameter_scale` is that of the
    /// metric. A method on that flow itself has none.
    ///
    /// # Errors
    /// A march that fails.
    fn error_ratio(
        &self,
        _local: &Self::Evaluation,
        _parameter_scale: f64,
    ) -> Result<f64, Self::Error> {
        Ok(0.0)
    }

    /// The same method with a finer unknown, where there is one.
    fn finer(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The same method with a coarser unknown, where there is one.
    fn coarser(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// An unknown of a coarser or a finer method as one of this.
    fn carried(&self, unknown: &[f64]) -> Vec<f64> {
        unknown.to_vec()
    }
}
