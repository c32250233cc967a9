//! Nearest fold of an orbit over the frequency of the drive.

use super::{
    AnalysisError, BranchKind, BranchPoint, Derivative, DerivativeKey, KnownOrbit, Model,
    Parameter, WarmStart, fold_derivatives,
};
use jounce_continuation::StepControl;
use jounce_orbits::{Orbit, OrbitError};
use jounce_spec::NumericKey;

/// Ends of the range of the frequency, relative to that of the drive.
const RANGE: [f64; 2] = [0.7, 1.3];

const TOLERANCE: f64 = 1e-8;

/// Length to which a fold is located, where a twentieth of the range counts as one.
const RESOLUTION: f64 = 1e-6;

/// Returns the key of the frequency of the first drive that has one, and its value, Hz.
pub fn drive_frequency(model: &Model) -> Option<(String, f64)> {
    let mut drives = model.spec.drive.iter();
    let (name, frequency_hz) =
        drives.find_map(|(name, drive)| Some((name, drive.frequency_hz()?)))?;
    Some((format!("drive.{name}.frequency"), frequency_hz))
}

/// Returns the distance of the end of the range from the frequency of the drive, Hz.
pub fn farthest_hz(model: &Model) -> Option<f64> {
    drive_frequency(model).map(|(_, frequency_hz)| (1.0 - RANGE[0]) * frequency_hz)
}

/// The branch of an orbit cannot be followed.
#[derive(Debug)]
pub struct NotFollowed;

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
    let (path, frequency_hz) = drive_frequency(model).ok_or(NotFollowed)?;
    let key = NumericKey::find(&model.spec, &path).map_err(|_| NotFollowed)?;
    let range = (RANGE[0] * frequency_hz, RANGE[1] * frequency_hz);
    let parameter = Parameter::new(model, &key, range.1 - range.0);
    let warm_start = WarmStart {
        harvester: &parameter,
        kernel: &model.kernel,
        range,
        tolerance: TOLERANCE,
        control: StepControl::default(),
        resolution: RESOLUTION,
    };
    let known = KnownOrbit {
        period_cycles,
        state: state.to_vec(),
        parameter: frequency_hz,
    };
    let branches = warm_start.run(&[known]).map_err(|_| NotFollowed)?;
    let folds = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|one| one.kind == BranchKind::Fold)
        .map(|one| &one.at);
    let distance = |fold: &BranchPoint| (fold.parameter - frequency_hz).abs();
    let nearest = folds.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    Ok(nearest.map(|point| FoldPlace {
        key: path,
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
        let at_fold = || -> Result<(NumericKey, Model), AnalysisError> {
            let frequency = NumericKey::find(&model.spec, &self.key)?;
            let mut spec = model.spec.clone();
            frequency.set(&mut spec, self.frequency_hz)?;
            Ok((frequency, model.changed(spec)?))
        };
        let (frequency, model) = at_fold().map_err(OrbitError::Harvester)?;
        let over = DerivativeKey {
            key: &frequency,
            scale: self.frequency_hz,
        };
        fold_derivatives(&model, &self.orbit, over, keys)
    }
}
