//! Nearest fold of an orbit over the frequency of the drive.

use crate::result::NearestFold;
use crate::search::Followed;
use jounce_analysis::{BranchKind, KnownOrbit, Parameter, WarmStart};
use jounce_continuation::StepControl;
use jounce_spec::NumericKey;

/// Ends of the range of the frequency, relative to that of the drive.
const RANGE: [f64; 2] = [0.7, 1.3];

const TOLERANCE: f64 = 1e-8;

/// Length to which a fold is located, where a twentieth of the range counts as one.
const RESOLUTION: f64 = 1e-6;

/// Returns the fold with the smallest distance from the frequency of the drive; `None` where the
/// branch has no fold within the range.
pub fn nearest_fold(followed: &Followed) -> Option<NearestFold> {
    let model = &followed.model;
    let mut drives = model.spec.drive.iter();
    let (name, frequency_hz) =
        drives.find_map(|(name, drive)| Some((name, drive.frequency_hz()?)))?;
    let path = format!("drive.{name}.frequency");
    let key = NumericKey::find(&model.spec, &path).ok()?;
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
        period_cycles: followed.orbit.period_cycles,
        state: followed.orbit.start().to_vec(),
        parameter: frequency_hz,
    };
    let branches = warm_start.run(&[known]).ok()?;
    let folds = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|one| one.kind == BranchKind::Fold)
        .map(|one| one.at.parameter);
    let distance = |fold: &f64| (fold - frequency_hz).abs();
    let nearest_hz = folds.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some(NearestFold {
        key: path,
        frequency_hz: nearest_hz,
        distance_hz: distance(&nearest_hz),
    })
}
