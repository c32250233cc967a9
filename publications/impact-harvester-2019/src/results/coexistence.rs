//! Coexisting orbits: the upward and downward sweeps continue at one frequency until transients
//! decay.

use super::stepped::SteppedBranch;
use crate::ReproduceError;
use crate::harvester::{MEGOHM, PaperCase, PaperHarvester};
use crate::impact::LONG_RUN_S;
use jounce_analysis::run::{RunPlan, StartState, simulate};

/// Distance from the peak of the upward sweep within which jumps are searched, Hz.
const AROUND_PEAK_HZ: f64 = 2.0;

/// Two continued runs at one frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coexistence {
    pub frequency_hz: f64,
    /// Mean power per force squared after the upward sweep, W/N^2.
    pub up_w_n2: f64,
    /// Mean power per force squared after the downward sweep, W/N^2.
    pub down_w_n2: f64,
}

impl Coexistence {
    /// Continues both sweeps at the frequency near the peak where they differ most.
    pub fn compute(
        harvester: &PaperHarvester,
        amplitude_n: f64,
        up: &SteppedBranch,
        down: &SteppedBranch,
    ) -> Result<Self, ReproduceError> {
        let (count, peak_hz) = (up.frequency_hz.len(), up.frequency_hz[up.peak()]);
        let factor = |index: usize| {
            let factor = up.power_w_n2[index] / down.power_w_n2[count - 1 - index];
            factor.max(1.0 / factor)
        };
        let near =
            (0..count).filter(|index| (up.frequency_hz[*index] - peak_hz).abs() <= AROUND_PEAK_HZ);
        let index = near
            .max_by(|a, b| factor(*a).total_cmp(&factor(*b)))
            .unwrap_or(0);
        let case = PaperCase {
            frequency_hz: up.frequency_hz[index],
            amplitude_n,
            resistance_ohm: MEGOHM,
        };
        let on = |state: &StartState| continue_run(harvester, case, state);
        Ok(Self {
            frequency_hz: case.frequency_hz,
            up_w_n2: on(&up.state[index])?,
            down_w_n2: on(&down.state[count - 1 - index])?,
        })
    }

    /// Returns the ratio of the two powers, at least 1.
    pub fn factor(&self) -> f64 {
        (self.up_w_n2 / self.down_w_n2).max(self.down_w_n2 / self.up_w_n2)
    }
}

fn continue_run(
    harvester: &PaperHarvester,
    case: PaperCase,
    state: &StartState,
) -> Result<f64, ReproduceError> {
    let kernel = harvester.kernel(case)?;
    let mut drives = kernel.plant.system.drives.clone();
    drives
        .iter_mut()
        .zip(&state.drive_angle_rad)
        .for_each(|(drive, angle_rad)| drive.phase_rad = *angle_rad);
    let plan = RunPlan {
        duration_s: LONG_RUN_S,
        ..harvester.plan()
    };
    Ok(case.normalised(simulate(&kernel.with_drives(drives)?, state, &plan)?.mean_power_w))
}
