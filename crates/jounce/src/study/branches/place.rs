//! A point of a walk with its orbit.

use super::branch::BranchPoint;
use super::events::Readings;
use super::follow::Following;
use crate::continuation::Step;
use crate::orbit::{Eigenbasis, OrbitMethod};
use std::sync::OnceLock;

/// A walked point with its orbit.
pub(super) struct Place<M: OrbitMethod> {
    pub step: Step<M::Local>,
    pub point: BranchPoint,
    readings: OnceLock<Option<Readings>>,
    eigenbasis: OnceLock<Option<Eigenbasis>>,
}

impl<M: OrbitMethod> Place<M> {
    /// Computes the orbit at a step.
    pub fn new(method: &M, step: Step<M::Local>) -> Result<Self, M::Error> {
        Ok(Self { point: point(method, &step)?, step, readings: OnceLock::new(), eigenbasis: OnceLock::new() })
    }

    /// What its test functions are made of, here and ahead; made when first asked for.
    pub fn readings(&self, method: &M, following: &Following) -> Option<&Readings> {
        let make = || Readings::of(method, (&self.step, &self.point.orbit), following.parameter_scale(), &following.levels);
        self.readings.get_or_init(make).as_ref()
    }

    /// Eigenvectors of its period map; made when first asked for.
    pub fn eigenbasis(&self, method: &M) -> &Option<Eigenbasis> {
        self.eigenbasis.get_or_init(|| Eigenbasis::of(&method.shot(&self.step.local).ok()?.block_map))
    }
}

/// The point of a branch at a step.
pub(super) fn point<M: OrbitMethod>(method: &M, step: &Step<M::Local>) -> Result<BranchPoint, M::Error> {
    let orbit = method.orbit(&step.local, step.error)?;
    Ok(BranchPoint { parameter: step.position.parameter, orbit })
}
