//! Mirror images of orbits.
//!
//! A symmetric harvester under a drive with `F(t + T/2) = -F(t)` has for every motion `x(t)` also
//! the motion `-x(t + T/2)`. The symmetry of the harvester is not tested: of two attracting orbits,
//! one is the mirror image of the other if it passes the mirrored states.

use jounce_dynamics::{IntegrationError, Integrator, Kernel};
use jounce_orbits::Orbit;

/// Returns the mirrored states of an orbit at the start of each drive cycle, in energy coordinates
/// of a scale. `cycle_s` is the length of the drive cycle.
pub fn mirrored_states(
    kernel: &Kernel,
    orbit: &Orbit,
    scale: &[f64],
    (cycle_s, tolerance): (f64, f64),
) -> Result<Vec<Vec<f64>>, IntegrationError> {
    let state = |strobe_state: &Vec<f64>| {
        let physical: Vec<f64> = strobe_state.iter().zip(scale).map(|(u, w)| u / w).collect();
        let mut integrator = Integrator::new(
            kernel,
            &kernel.plant.from_physical(&physical, 0.0),
            0.0,
            tolerance,
        )?;
        integrator.advance_to(0.5 * cycle_s)?;
        Ok(integrator
            .physical()
            .iter()
            .zip(scale)
            .map(|(x, w)| -x * w)
            .collect())
    };
    orbit
        .strobe_states
        .iter()
        .take(orbit.period_cycles as usize)
        .map(state)
        .collect()
}
