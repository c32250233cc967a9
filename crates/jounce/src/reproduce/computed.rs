//! All numbers of the reproduction, before they become tables, figures and claims.

use super::ReproduceError;
use super::assumptions::{Variant, variants};
use super::frequency_responses::HammerTest;
use super::harvester::{ABOVE_RESONANCE, BELOW_RESONANCE, Harvester};
use super::power_over_frequency::PowerOverFrequency;
use super::power_over_resistance::PowerOverResistance;
use super::table_2::Frequencies;
use super::voltage::VoltageRecord;
use crate::linear::{Coupling, couplings};
use crate::run::{RunAnswer, RunPlan, StartState, simulate};

/// Length of the runs that show what a case settles to, s.
pub(super) const LONG_RUN_S: f64 = 200.0;

/// Everything that is computed.
pub(super) struct Computed {
    pub harvester: Harvester,
    pub table_2: Frequencies,
    pub hammer: HammerTest,
    pub frequency: PowerOverFrequency,
    pub voltage: VoltageRecord,
    pub above: PowerOverResistance,
    pub below: PowerOverResistance,
    pub below_run: RunAnswer,
    /// 13 Hz and 200 N for [`LONG_RUN_S`].
    pub long_run: RunAnswer,
    /// The first bending mode of the harvester on its table.
    pub first_mode: Coupling,
    /// Frequency of its second bending mode, Hz.
    pub second_mode_hz: f64,
    pub variants: Vec<Variant>,
}

impl Computed {
    /// Computes everything; the many runs share all cores.
    pub fn new(progress: &dyn Fn(&str)) -> Result<Self, ReproduceError> {
        progress("Table 2, figures 4 and 5: modes and frequency responses");
        let (table_2, hammer, harvester) = (Frequencies::compute()?, HammerTest::compute()?, Harvester::with(&[])?);
        progress("figures 6, 8 and 9: 1088 runs of 20 s");
        let (frequency, resistances) = rayon::join(
            || PowerOverFrequency::compute(&harvester),
            || {
                rayon::join(
                    || PowerOverResistance::compute(&harvester, ABOVE_RESONANCE),
                    || PowerOverResistance::compute(&harvester, BELOW_RESONANCE),
                )
            },
        );
        progress("figure 7: voltage at 13 Hz and 200 N");
        let voltage = VoltageRecord::compute(&harvester)?;
        progress("assumptions: 13 Hz and 200 N with the other choices");
        let variants = variants()?;
        // Mode 0 is that of the table on its spring.
        let bending: Vec<Coupling> = couplings(&harvester.system.modes).into_iter().filter(|coupling| coupling.mode > 0).collect();
        Ok(Self {
            first_mode: bending[0].clone(),
            second_mode_hz: bending[1].short_circuit_hz,
            long_run: long_run(&harvester)?,
            below_run: harvester.run(BELOW_RESONANCE)?,
            above: resistances.0?,
            below: resistances.1?,
            frequency: frequency?,
            table_2,
            hammer,
            harvester,
            voltage,
            variants,
        })
    }
}

/// 13 Hz and 200 N from rest for [`LONG_RUN_S`], the last 10 s averaged.
pub(super) fn long_run(harvester: &Harvester) -> Result<RunAnswer, ReproduceError> {
    let kernel = harvester.kernel(ABOVE_RESONANCE)?;
    let plan = RunPlan { duration_s: LONG_RUN_S, ..harvester.plan() };
    Ok(simulate(&kernel, &StartState::rest(&kernel.plant), &plan)?)
}
