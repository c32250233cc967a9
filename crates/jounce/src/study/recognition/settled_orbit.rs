//! The orbit that one start reaches.

use super::recognizer::{Recognition, Recognizer};
use crate::orbit::{Harvester, Orbit};

/// Drive cycles after which a start gives no orbit.
const MAX_CYCLES: u32 = 4096;

/// The stable orbit that the motion from `start` (physical) reaches, of those that can be followed: it does not rest on a rigid stop.
/// `None` where none is proved to be reached. `goal` is Newton's, relative to the state.
pub fn settled_orbit<H: Harvester>(harvester: &H, parameter: f64, start: &[f64], tolerance: f64, goal: f64) -> Option<Orbit> {
    let setting = harvester.at(parameter).ok()?;
    setting.kernel.plant.period_s()?;
    let options = Recognition { goal, max_cycles: MAX_CYCLES, ..Recognition::at(tolerance) };
    let recognizer = Recognizer { harvester, kernel: &setting.kernel, parameter, options };
    let found = recognizer.settle(start, &[]);
    found.orbit().map(|found| found.orbit.clone()).filter(|orbit| !orbit.multipliers.is_empty())
}
