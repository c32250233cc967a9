//! Frequency sweeps up and down with the state carried over and continuous phase, as in the paper's
//! figure 6.

use super::coexistence::Coexistence;
use crate::ReproduceError;
use crate::harvester::{MEGOHM, PaperCase, PaperHarvester};
use jounce_analysis::run::{StartState, simulate};

/// One direction of a stepped sweep.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct SteppedBranch {
    pub frequency_hz: Vec<f64>,
    /// Mean power per force squared, W/N^2.
    pub power_w_n2: Vec<f64>,
    pub settled: Vec<bool>,
    /// Period of the orbit in drive cycles, if it has settled.
    pub period_cycles: Vec<u32>,
    /// Final state of each point.
    pub state: Vec<StartState>,
}

/// Force level swept up and then down.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DriveLevel {
    pub amplitude_n: f64,
    pub up: SteppedBranch,
    pub down: SteppedBranch,
    pub coexistence: Coexistence,
}

/// Sweeps the frequencies up and then down, from rest at the first frequency.
pub(super) fn stepped(
    harvester: &PaperHarvester,
    amplitude_n: f64,
    frequencies_hz: &[f64],
) -> Result<DriveLevel, ReproduceError> {
    let first = PaperCase {
        frequency_hz: frequencies_hz[0],
        amplitude_n,
        resistance_ohm: MEGOHM,
    };
    let (mut kernel, plan) = (harvester.kernel(first)?, harvester.plan());
    let mut state = StartState::rest(&kernel.plant);
    let (mut up, mut down) = (SteppedBranch::default(), SteppedBranch::default());
    let back = frequencies_hz
        .iter()
        .rev()
        .map(|frequency_hz| (frequency_hz, false));
    for (&frequency_hz, is_up) in frequencies_hz
        .iter()
        .map(|frequency_hz| (frequency_hz, true))
        .chain(back)
    {
        let mut drives = kernel.plant.system.drives.clone();
        for (drive, angle_rad) in drives.iter_mut().zip(&state.drive_angle_rad) {
            drive.frequency_hz = frequency_hz;
            drive.phase_rad = *angle_rad;
        }
        kernel = kernel.with_drives(drives)?;
        let result = simulate(&kernel, &state, &plan)?;
        harvester.control.count();
        let branch = if is_up { &mut up } else { &mut down };
        branch.frequency_hz.push(frequency_hz);
        branch
            .power_w_n2
            .push(first.normalised(result.mean_power_w));
        branch.settled.push(
            result
                .settlement
                .is_some_and(|settlement| settlement.settled),
        );
        branch.period_cycles.push(
            result
                .settlement
                .map_or(0, |settlement| settlement.period_cycles),
        );
        branch.state.push(result.end.clone());
        state = result.end;
    }
    let coexistence = Coexistence::compute(harvester, amplitude_n, &up, &down)?;
    Ok(DriveLevel {
        amplitude_n,
        up,
        down,
        coexistence,
    })
}

impl SteppedBranch {
    /// Returns the index of the highest power.
    pub fn peak(&self) -> usize {
        (0..self.power_w_n2.len())
            .max_by(|&a, &b| self.power_w_n2[a].total_cmp(&self.power_w_n2[b]))
            .unwrap_or(0)
    }

    /// Returns the steepest change between neighbours in the order of stepping: the index before it
    /// and the factor, at least 1.
    pub fn steepest(&self) -> (usize, f64) {
        let factor = |pair: &[f64]| (pair[1] / pair[0]).max(pair[0] / pair[1]);
        let factors = self.power_w_n2.windows(2).map(factor).enumerate();
        factors
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0, 1.0))
    }
}
