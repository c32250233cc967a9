//! Where one start ends.

use super::lyapunov::{Lyapunov, largest_exponent};
use crate::march::{Kernel, Marcher, VariationError};
use crate::orbit::{Harvester, Orbit};
use crate::study::branches::settled_orbit;

/// Drive cycles before an exponent is taken.
const TRANSIENT_CYCLES: f64 = 500.0;

/// Drive cycles over which an exponent is taken.
const EXPONENT_CYCLES: usize = 320;

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
        if let Some(orbit) = settled_orbit(harvester, value, start, tolerance, 10.0 * tolerance) {
            return Fate::Orbit(orbit);
        }
        let wander = || -> Result<Lyapunov, VariationError> {
            let cycle_s = kernel.plant.tones.first().map_or(1.0, |tone| std::f64::consts::TAU / tone.angular_frequency_rad_s);
            let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(start, 0.0), 0.0, tolerance)?;
            marcher.advance_to(TRANSIENT_CYCLES * cycle_s)?;
            largest_exponent(kernel, &marcher.state(), EXPONENT_CYCLES, tolerance)
        };
        wander().map_or_else(|error| Fate::Lost(error.to_string()), Fate::Wandering)
    }
}
