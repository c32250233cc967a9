//! A start from a stronger drive.

use crate::integrate::{Integrator, Kernel};

/// How much stronger the drive is at first.
const INITIAL_DRIVE_FACTOR: f64 = 4.0;

/// Steps in which it comes down, each by the same share.
const RAMP_STEPS: u32 = 12;

/// Drive cycles of a step.
const CYCLES_PER_STEP: u32 = 30;

/// The physical state that a march from rest comes to while all drives are eased from a multiple of their amplitudes down to them. Where a strong
/// drive leaves one answer, the large one, the march stays on it as long as it goes on, and no start under the drive itself need lead there.
/// `None` where a march fails.
pub fn eased(kernel: &Kernel, tolerance: f64) -> Option<Vec<f64>> {
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
