//! Interface of a method of computing orbits, in addition to its residual.

use super::{Orbit, OrbitError, ShootingEvaluation};
use jounce_continuation::Problem;

/// Method of computing orbits of a parametrised harvester.
pub trait OrbitMethod: Problem<Error = OrbitError<Self::Fault>> {
    /// Error of building a harvester.
    type Fault: std::error::Error;

    /// Returns the number of drive cycles in the period.
    fn cycles(&self) -> u32;

    /// Returns the orbit at a converged point; `error` is the remaining Newton error, relative to
    /// the unknown.
    ///
    /// # Errors
    /// The multipliers cannot be computed.
    fn orbit(&self, local: &Self::Evaluation, error: f64) -> Result<Orbit, Self::Error>;

    /// Returns the period integrated with the exact flow from a point: its multipliers, contacts
    /// and turning points.
    ///
    /// # Errors
    /// The integration fails.
    fn shot<'l>(&self, local: &'l Self::Evaluation) -> Result<&'l ShootingEvaluation, Self::Error>;

    /// Integrates the period with the exact flow from a state in energy coordinates, at a tenth of
    /// the tolerance.
    ///
    /// # Errors
    /// The integration fails.
    fn finer_shot(&self, state: &[f64], parameter: f64) -> Result<ShootingEvaluation, Self::Error>;

    /// Returns the unknown that represents a state in energy coordinates.
    ///
    /// # Errors
    /// The integration fails.
    fn unknown_of(&self, state: &[f64], parameter: f64) -> Result<Vec<f64>, Self::Error>;

    /// Returns the distance of the solution at a point from the curve of the exact flow, divided by
    /// the allowed distance. `parameter_scale` belongs to the metric. A method on the exact flow
    /// returns 0.
    ///
    /// # Errors
    /// The integration fails.
    fn error_ratio(
        &self,
        _local: &Self::Evaluation,
        _parameter_scale: f64,
    ) -> Result<f64, Self::Error> {
        Ok(0.0)
    }

    /// Returns this method with a finer unknown, where one exists.
    fn finer(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Returns this method with a coarser unknown, where one exists.
    fn coarser(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Converts an unknown of a coarser or a finer method to one of this method.
    fn resampled(&self, unknown: &[f64]) -> Vec<f64> {
        unknown.to_vec()
    }
}
