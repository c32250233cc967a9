//! The change to a finer method on the way along a branch.

use super::follow::Following;
use crate::continuation::{Direction, Family, Metric, Position, Step, correct, tangent};
use crate::orbit::OrbitMethod;

/// Share of its excess that a finer method must get rid of: what stays is no matter of the number of unknowns.
const HELPS: f64 = 0.6;

/// A finer method with a place in its unknown, where one is needed.
type Finer<M> = Option<(M, Step<<M as Family>::Local>)>;

impl Following {
    /// A method fine enough for the orbit at `rough`, where this one is not and a finer one is better; with `from` in its unknown.
    pub(super) fn finer<M: OrbitMethod>(&self, method: &M, rough: &Step<M::Local>, from: &Step<M::Local>) -> Result<Finer<M>, M::Error> {
        let mut excess = method.excess(&rough.local, self.parameter_scale())?;
        let mut found: Finer<M> = None;
        let mut next = method.finer();
        while let Some(finer) = next.filter(|_| excess > 1.0) {
            let (Some(there), Some(back)) = (self.carried(&finer, rough), self.carried(&finer, from)) else { break };
            let before = std::mem::replace(&mut excess, finer.excess(&there.local, self.parameter_scale())?);
            if excess > HELPS * before {
                break;
            }
            next = finer.finer();
            found = Some((finer, back));
        }
        Ok(found)
    }

    /// A place of a coarser method, corrected by a finer one.
    fn carried<M: OrbitMethod>(&self, finer: &M, step: &Step<M::Local>) -> Option<Step<M::Local>> {
        let guess = Position { unknown: finer.carried(&step.position.unknown), parameter: step.position.parameter };
        let metric = Metric::at(&guess, self.parameter_scale());
        let ahead = Direction { unknown: finer.carried(&step.tangent.unknown), parameter: step.tangent.parameter };
        let found = correct(finer, &self.corrector, &metric, &ahead, guess).ok()?;
        let tangent = tangent(&found.local, &metric, &ahead)?;
        Some(Step { position: found.position, tangent, local: found.local, error: found.error })
    }
}
