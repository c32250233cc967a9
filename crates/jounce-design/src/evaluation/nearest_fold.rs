//! Nearest fold of an orbit over the frequency of the drive.

use super::MainOrbit;
use crate::result::NearestFold;
use jounce_analysis::{BranchKind, KnownOrbit, Model, Parameter, WarmStart};
use jounce_continuation::StepControl;
use jounce_spec::NumericKey;

/// Ends of the range of the frequency, relative to that of the drive.
const RANGE: [f64; 2] = [0.7, 1.3];

const TOLERANCE: f64 = 1e-8;

/// Length to which a fold is located, where a twentieth of the range counts as one.
const RESOLUTION: f64 = 1e-6;

/// Returns the key of the frequency of the first drive that has one, and its value, Hz.
pub(super) fn drive_frequency(model: &Model) -> Option<(String, f64)> {
    let mut drives = model.spec.drive.iter();
    let (name, frequency_hz) =
        drives.find_map(|(name, drive)| Some((name, drive.frequency_hz()?)))?;
    Some((format!("drive.{name}.frequency"), frequency_hz))
}

/// Returns the distance of the nearest fold from the frequency of the drive, Hz: that of the end of
/// the range without a fold; NaN where the branch cannot be followed.
pub fn fold_distance_hz(model: &Model, orbit: &MainOrbit) -> f64 {
    match (nearest_fold(model, orbit), farthest_hz(model)) {
        (Ok(Some(fold)), _) => fold.distance_hz,
        (Ok(None), Some(farthest_hz)) => farthest_hz,
        _ => f64::NAN,
    }
}

/// Returns the distance of the end of the range from the frequency of the drive, Hz.
pub fn farthest_hz(model: &Model) -> Option<f64> {
    drive_frequency(model).map(|(_, frequency_hz)| (1.0 - RANGE[0]) * frequency_hz)
}

/// The branch of an orbit cannot be followed.
#[derive(Debug)]
pub struct NotFollowed;

/// Returns the fold with the smallest distance from the frequency of the drive; `None` where the
/// branch has no fold within the range.
pub fn nearest_fold(model: &Model, orbit: &MainOrbit) -> Result<Option<NearestFold>, NotFollowed> {
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
        period_cycles: orbit.period_cycles,
        state: orbit.state.clone(),
        parameter: frequency_hz,
    };
    let branches = warm_start.run(&[known]).map_err(|_| NotFollowed)?;
    let folds = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|one| one.kind == BranchKind::Fold)
        .map(|one| one.at.parameter);
    let distance = |fold: &f64| (fold - frequency_hz).abs();
    let nearest_hz = folds.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    Ok(nearest_hz.map(|frequency_hz| NearestFold {
        key: path,
        frequency_hz,
        distance_hz: distance(&frequency_hz),
    }))
}
