//! Nearest fold of an orbit over the frequency of the drive, and how far the tolerances move it.

use super::MainOrbit;
use crate::problem::Tolerance;
use crate::result::NearestFold;
use jounce_analysis::{
    BranchKind, BranchPoint, DerivativeKey, KnownOrbit, Model, Parameter, WarmStart,
    fold_derivatives,
};
use jounce_continuation::StepControl;
use jounce_orbits::Orbit;
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
        (Ok(Some((fold, _))), _) => fold.distance_hz,
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

/// Returns the fold with the smallest distance from the frequency of the drive, and the orbit there;
/// `None` where the branch has no fold within the range.
pub fn nearest_fold(
    model: &Model,
    orbit: &MainOrbit,
) -> Result<Option<(NearestFold, Orbit)>, NotFollowed> {
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
        .map(|one| &one.at);
    let distance = |fold: &BranchPoint| (fold.parameter - frequency_hz).abs();
    let nearest = folds.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    Ok(nearest.map(|point| {
        let fold = NearestFold {
            key: path,
            frequency_hz: point.parameter,
            distance_hz: distance(point),
            scatter_hz: None,
        };
        (fold, point.orbit.clone())
    }))
}

/// Returns the standard deviation of the frequency of a fold by tolerances, to first order; `None`
/// without tolerances, and where the derivatives are not known.
pub fn scatter_hz(
    model: &Model,
    (fold, orbit): (&NearestFold, &Orbit),
    tolerances: &[Tolerance],
) -> Option<f64> {
    if tolerances.is_empty() {
        return None;
    }
    let frequency = NumericKey::find(&model.spec, &fold.key).ok()?;
    let mut spec = model.spec.clone();
    frequency.set(&mut spec, fold.frequency_hz).ok()?;
    let model = model.changed(spec).ok()?;
    let key = |tolerance: &'_ Tolerance| (tolerance.key.clone(), tolerance.standard_deviation());
    let keys: Vec<(NumericKey, f64)> = tolerances.iter().map(key).collect();
    let wanted: Vec<DerivativeKey<'_>> = keys
        .iter()
        .map(|(key, deviation)| {
            let value = key.get(&model.spec).map_or(0.0, f64::abs);
            let scale = value.max(*deviation);
            DerivativeKey { key, scale }
        })
        .collect();
    let over = DerivativeKey {
        key: &frequency,
        scale: fold.frequency_hz,
    };
    let derivatives = fold_derivatives(&model, orbit, over, &wanted).ok()?;
    let parts = derivatives.iter().zip(&keys);
    Some(parts.fold(0.0, |sum: f64, (by, (_, deviation))| {
        sum.hypot(by * deviation)
    }))
}
