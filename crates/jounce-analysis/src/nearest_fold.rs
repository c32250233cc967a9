//! Nearest fold of an orbit over the frequency of the drive.

use super::frequency_branch::{FrequencyBranch, NotFollowed, at_frequency};
use super::{
    AnalysisError, BranchKind, BranchPoint, Derivative, DerivativeKey, Model, fold_derivatives,
};
use jounce_orbits::{Orbit, OrbitError};

/// Fold of a branch over the frequency of the drive.
#[derive(Debug, Clone, PartialEq)]
pub struct FoldPlace {
    /// Key of the frequency.
    pub key: String,
    /// Frequency of the fold, Hz.
    pub frequency_hz: f64,
    /// Distance from the frequency of the drive, Hz.
    pub distance_hz: f64,
    /// Orbit at the fold.
    pub orbit: Orbit,
}

/// Returns the fold of the branch of an orbit with the smallest distance from the frequency of the
/// drive, within 30 % of it; `state` is that at the start of the orbit, energy coordinates. `None`
/// where the branch has no fold there.
///
/// # Errors
/// The branch cannot be followed.
pub fn nearest_fold(
    model: &Model,
    period_cycles: u32,
    state: &[f64],
) -> Result<Option<FoldPlace>, NotFollowed> {
    let FrequencyBranch {
        key,
        frequency_hz,
        branches,
        ..
    } = FrequencyBranch::of(model, period_cycles, state)?;
    let folds = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|one| one.kind == BranchKind::Fold)
        .map(|one| &one.at);
    let distance = |fold: &BranchPoint| (fold.parameter - frequency_hz).abs();
    let nearest = folds.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    Ok(nearest.map(|point| FoldPlace {
        key: key.path().to_owned(),
        frequency_hz: point.parameter,
        distance_hz: distance(point),
        orbit: point.orbit.clone(),
    }))
}

impl FoldPlace {
    /// Returns the derivatives of the frequency of the fold by keys, Hz per SI unit of the key.
    ///
    /// # Errors
    /// As [`fold_derivatives`].
    pub fn derivatives(
        &self,
        model: &Model,
        keys: &[DerivativeKey<'_>],
    ) -> Result<Vec<Derivative>, OrbitError<AnalysisError>> {
        let (frequency, model) =
            at_frequency(model, &self.key, self.frequency_hz).map_err(OrbitError::Harvester)?;
        let over = DerivativeKey {
            key: &frequency,
            scale: self.frequency_hz,
        };
        fold_derivatives(&model, &self.orbit, over, keys)
    }
}
