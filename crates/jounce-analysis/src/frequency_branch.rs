//! Branch of an orbit over the frequency of the drive.

use super::{AnalysisError, Branch, KnownOrbit, Model, Parameter, WarmStart};
use jounce_continuation::StepControl;
use jounce_spec::NumericKey;

/// Ends of the range of the frequency, relative to that of the drive.
const RANGE: [f64; 2] = [0.7, 1.3];

/// Relative tolerance of the integrations.
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

/// Branch of an orbit over the frequency of the drive, within 30 % of it.
pub(super) struct FrequencyBranch {
    /// Key of the frequency.
    pub key: NumericKey,
    /// Frequency of the drive, Hz.
    pub frequency_hz: f64,
    /// Width of the range, Hz.
    pub width_hz: f64,
    /// The branch, in both directions from the orbit.
    pub branches: Vec<Branch>,
}

impl FrequencyBranch {
    /// Follows the branch of an orbit; `state` is that at its start, energy coordinates.
    ///
    /// # Errors
    /// The branch cannot be followed.
    pub fn of(model: &Model, period_cycles: u32, state: &[f64]) -> Result<Self, NotFollowed> {
        let (path, frequency_hz) = drive_frequency(model).ok_or(NotFollowed)?;
        let key = NumericKey::find(&model.spec, &path).map_err(|_| NotFollowed)?;
        let range = (RANGE[0] * frequency_hz, RANGE[1] * frequency_hz);
        let parameter = Parameter::new(model, &key, range.1 - range.0);
        let warm_start = WarmStart {
            family: &parameter,
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
        Ok(Self {
            key,
            frequency_hz,
            width_hz: range.1 - range.0,
            branches,
        })
    }
}

/// Returns the key of the frequency with a path, and the model at another frequency, Hz.
///
/// # Errors
/// The model cannot be built there.
pub(super) fn at_frequency(
    model: &Model,
    path: &str,
    frequency_hz: f64,
) -> Result<(NumericKey, Model), AnalysisError> {
    let frequency = NumericKey::find(&model.spec, path)?;
    let mut spec = model.spec.clone();
    frequency.set(&mut spec, frequency_hz)?;
    Ok((frequency, model.changed(spec)?))
}
