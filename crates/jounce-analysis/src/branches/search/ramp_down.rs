//! Start from a stronger drive.

use jounce_dynamics::{Integrator, Kernel};

/// Initial amplitude of the drive relative to its final one.
const INITIAL_DRIVE_FACTOR: f64 = 4.0;

/// Number of steps of the ramp, of equal ratio.
const RAMP_STEPS: u32 = 12;

/// Drive cycles of a step.
const CYCLES_PER_STEP: u32 = 30;

/// Integrates from rest while all drives are ramped down from a multiple of their amplitudes, and
/// returns the physical state. A strong drive may leave only the large response, and the
/// integration stays on it as long as it exists. Starts under the final drive may not lead there.
/// `None` where an integration fails.
pub fn ramped_down_start(kernel: &Kernel, tolerance: f64) -> Option<Vec<f64>> {
    let cycle_s = kernel.plant.period_s()?;
    let mut state = vec![0.0; kernel.plant.len()];
    for step in 0..RAMP_STEPS {
        let stronger = INITIAL_DRIVE_FACTOR.powf(1.0 - f64::from(step) / f64::from(RAMP_STEPS));
        let mut drives = kernel.plant.system.drives.clone();
        drives
            .iter_mut()
            .for_each(|drive| drive.amplitude_n *= stronger);
        let strong = kernel.with_drives(drives).ok()?;
        let mut integrator = Integrator::new(
            &strong,
            &strong.plant.from_physical(&state, 0.0),
            0.0,
            tolerance,
        )
        .ok()?;
        integrator
            .advance_to(f64::from(CYCLES_PER_STEP) * cycle_s)
            .ok()?;
        state = strong.plant.to_physical(&integrator.state(), 0.0);
    }
    Some(state)
}
