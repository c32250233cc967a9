//! Nearest fold of an orbit over the frequency of the drive, and bifurcations that are nearer.

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

/// Bifurcation, other than a fold, at which the orbits of a branch may lose their stability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BifurcationPlace {
    /// Kind.
    pub kind: BranchKind,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Distance from the frequency of the drive, Hz.
    pub distance_hz: f64,
}

/// Bifurcations of a branch next to the frequency of the drive.
#[derive(Debug, Clone, PartialEq)]
pub struct NearestBifurcations {
    /// The nearest fold; `None` where the branch has none within 30 % of the frequency.
    pub fold: Option<FoldPlace>,
    /// The nearest other bifurcation, if it is nearer than the fold.
    pub nearer: Option<BifurcationPlace>,
}

/// Returns the bifurcations of the branch of an orbit with the smallest distance from the frequency of
/// the drive, within 30 % of it; `state` is that at the start of the orbit, energy coordinates.
///
/// # Errors
/// The branch cannot be followed.
pub fn nearest_bifurcations(
    model: &Model,
    period_cycles: u32,
    state: &[f64],
) -> Result<NearestBifurcations, NotFollowed> {
    let FrequencyBranch {
        key,
        frequency_hz,
        branches,
        ..
    } = FrequencyBranch::of(model, period_cycles, state)?;
    let distance = |point: &BranchPoint| (point.parameter - frequency_hz).abs();
    let nearest = |kinds: &[BranchKind]| {
        let all = branches.iter().flat_map(|branch| &branch.bifurcations);
        all.filter(|one| kinds.contains(&one.kind))
            .min_by(|a, b| distance(&a.at).total_cmp(&distance(&b.at)))
    };
    let fold = nearest(&[BranchKind::Fold]).map(|one| FoldPlace {
        key: key.path().to_owned(),
        frequency_hz: one.at.parameter,
        distance_hz: distance(&one.at),
        orbit: one.at.orbit.clone(),
    });
    let others = [
        BranchKind::PeriodDoubling,
        BranchKind::NeimarkSacker,
        BranchKind::BranchPoint,
    ];
    let other = nearest(&others).map(|one| BifurcationPlace {
        kind: one.kind,
        frequency_hz: one.at.parameter,
        distance_hz: distance(&one.at),
    });
    let fold_distance_hz = fold.as_ref().map_or(f64::INFINITY, |fold| fold.distance_hz);
    let nearer = other.filter(|other| other.distance_hz < fold_distance_hz);
    Ok(NearestBifurcations { fold, nearer })
}

/// Returns the nearest fold of [`nearest_bifurcations`].
///
/// # Errors
/// The branch cannot be followed.
pub fn nearest_fold(
    model: &Model,
    period_cycles: u32,
    state: &[f64],
) -> Result<Option<FoldPlace>, NotFollowed> {
    Ok(nearest_bifurcations(model, period_cycles, state)?.fold)
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
