//! Where one start ends.

use super::lyapunov::{Lyapunov, Wandering, largest_exponent};
use crate::march::{Kernel, MarchError, Marcher, VariationError};
use crate::orbit::{Harvester, Orbit};
use crate::study::branches::settled_motion;

/// Drive cycles before an exponent is taken.
const TRANSIENT_CYCLES: f64 = 500.0;

/// Drive cycles over which an exponent is taken.
const EXPONENT_CYCLES: usize = 320;

/// Drive cycles over which chaos must show itself once more: one exponent in a few hundred is too large by chance.
const PROOF_CYCLES: usize = 4 * EXPONENT_CYCLES;

/// Times that the search for an orbit is taken up again where neighbours close up.
const ROUNDS: u32 = 3;

/// Drive cycles marched before that.
const PATIENCE_CYCLES: f64 = 3000.0;

/// Where a start ends.
#[derive(Debug, Clone, PartialEq)]
pub enum Fate {
    /// On a periodic orbit.
    Orbit(Orbit),
    /// On no orbit that was looked for, after a long march.
    Wandering(Lyapunov),
    /// Nowhere: the march failed.
    Lost(String),
}

impl Fate {
    /// Marches from a physical start until it is recognised.
    pub fn of<H: Harvester>(harvester: &H, (kernel, value): (&Kernel, f64), start: &[f64], tolerance: f64) -> Self {
        let mut state = start.to_vec();
        let mut round = 0;
        loop {
            if let Some(orbit) = settled_motion(harvester, value, &state, tolerance, 10.0 * tolerance) {
                return Fate::Orbit(orbit);
            }
            round += 1;
            match wander(kernel, &state, tolerance) {
                // Still on its way to something: it gets more time.
                Ok((found, later)) if found.wandering() == Wandering::Unsettled && round < ROUNDS => state = later,
                Ok((found, _)) => return Fate::Wandering(found),
                Err(error) => return Fate::Lost(error.to_string()),
            }
        }
    }
}

/// The exponent of a motion without a period, and its physical state much later.
fn wander(kernel: &Kernel, start: &[f64], tolerance: f64) -> Result<(Lyapunov, Vec<f64>), VariationError> {
    let (mut marcher, cycle_s) = settled(kernel, start, tolerance)?;
    let state = marcher.state();
    let mut found = largest_exponent(kernel, &state, EXPONENT_CYCLES, tolerance)?;
    match found.wandering() {
        Wandering::Chaos => found = largest_exponent(kernel, &state, PROOF_CYCLES, tolerance)?,
        Wandering::Unsettled => marcher.advance_to(PATIENCE_CYCLES * cycle_s)?,
        Wandering::Torus => {}
    }
    Ok((found, kernel.plant.to_physical(&marcher.state(), 0.0)))
}

/// The physical state of a motion that its transient has left.
pub(super) fn late_state(kernel: &Kernel, start: &[f64], tolerance: f64) -> Result<Vec<f64>, MarchError> {
    Ok(kernel.plant.to_physical(&settled(kernel, start, tolerance)?.0.state(), 0.0))
}

/// A march from a physical start past its transient, and the length of a drive cycle, s.
fn settled<'k>(kernel: &'k Kernel, start: &[f64], tolerance: f64) -> Result<(Marcher<'k>, f64), MarchError> {
    let cycle_s = kernel.plant.period_s().unwrap_or(1.0);
    let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(start, 0.0), 0.0, tolerance)?;
    marcher.advance_to(TRANSIENT_CYCLES * cycle_s)?;
    Ok((marcher, cycle_s))
}
