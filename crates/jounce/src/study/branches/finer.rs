//! The change to a finer method on the way along a branch.

use super::follow::Following;
use crate::continuation::{Direction, Family, Metric, Position, Step, correct, tangent};
use crate::orbit::OrbitMethod;

/// A finer method with a place in its unknown, where one is needed.
type Finer<M> = Option<(M, Step<<M as Family>::Local>)>;

impl Following {
    /// A method fine enough for the orbit at `rough`, where this one is not; with `from` in its unknown.
    pub(super) fn finer<M: OrbitMethod>(&self, method: &M, rough: &Step<M::Local>, from: &Step<M::Local>) -> Result<Finer<M>, M::Error> {
        let Some(finer) = method.finer(&rough.local, self.parameter_scale())? else { return Ok(None) };
        let there = |step: &Step<M::Local>| {
            let guess = Position { unknown: finer.carried(&step.position.unknown), parameter: step.position.parameter };
            let metric = Metric::at(&guess, self.parameter_scale());
            let ahead = Direction { unknown: finer.carried(&step.tangent.unknown), parameter: step.tangent.parameter };
            let found = correct(&finer, &self.corrector, &metric, &ahead, guess).ok()?;
            let tangent = tangent(&found.local, &metric, &ahead)?;
            Some(Step { position: found.position, tangent, local: found.local, error: found.error })
        };
        let (Some(rough), Some(from)) = (there(rough), there(from)) else { return Ok(None) };
        Ok(match self.finer(&finer, &rough, &from)? {
            Some(finest) => Some(finest),
            None => Some((finer, from)),
        })
    }
}
