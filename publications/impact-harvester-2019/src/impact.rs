//! All impact results of the paper for one position of the stop.

use super::ReproduceError;
use super::harvester::{ABOVE_RESONANCE, BELOW_RESONANCE, PaperHarvester};
use crate::results::power_over_frequency::PowerOverFrequency;
use crate::results::power_over_resistance::PowerOverResistance;
use crate::results::voltage::VoltageRecord;
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_control::Control;
use jounce_model::linear::{Coupling, couplings};

/// Duration of the runs that reach steady state, s.
pub(super) const LONG_RUN_S: f64 = 100.0;

/// Figures 6 to 9 and their runs.
pub(super) struct Impact {
    pub harvester: PaperHarvester,
    pub frequency: PowerOverFrequency,
    pub voltage: VoltageRecord,
    pub above: PowerOverResistance,
    pub below: PowerOverResistance,
    pub below_run: RunResult,
    /// Run at 13 Hz and 200 N for [`LONG_RUN_S`].
    pub long_run: RunResult,
    /// First bending mode of the harvester on its table.
    pub first_mode: Coupling,
    /// Frequency of the second bending mode, Hz.
    pub second_mode_hz: f64,
}

impl Impact {
    /// Computes all runs with the stop on `"ground"` or `"table"`, figure 6 at some force levels,
    /// N; the runs use all cores.
    pub fn compute(
        frame: &str,
        levels_n: &[f64],
        control: &Control,
    ) -> Result<Self, ReproduceError> {
        let harvester =
            PaperHarvester::with(&[("stop.tip.frame".to_owned(), frame.to_owned())], control)?;
        let (frequency, (above, below)) = rayon::join(
            || PowerOverFrequency::compute(&harvester, levels_n),
            || {
                let over = |case| PowerOverResistance::compute(&harvester, case);
                rayon::join(|| over(ABOVE_RESONANCE), || over(BELOW_RESONANCE))
            },
        );
        // Mode 0 is the table on its spring.
        let bending: Vec<Coupling> = couplings(&harvester.system.modes)
            .into_iter()
            .filter(|coupling| coupling.mode > 0)
            .collect();
        Ok(Self {
            frequency: frequency?,
            voltage: VoltageRecord::compute(&harvester)?,
            above: above?,
            below: below?,
            below_run: harvester.run(BELOW_RESONANCE)?,
            long_run: long_run(&harvester)?,
            first_mode: bending[0].clone(),
            second_mode_hz: bending[1].short_circuit_hz,
            harvester,
        })
    }
}

/// Runs 13 Hz and 200 N from rest for [`LONG_RUN_S`], the last 10 s averaged.
pub(super) fn long_run(harvester: &PaperHarvester) -> Result<RunResult, ReproduceError> {
    let kernel = harvester.kernel(ABOVE_RESONANCE)?;
    let plan = RunPlan {
        duration_s: LONG_RUN_S,
        ..harvester.plan()
    };
    Ok(simulate(&kernel, &StartState::rest(&kernel.plant), &plan)?)
}
