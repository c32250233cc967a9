//! Results of the two runs behind the paper's figures 7 to 9.

use crate::harvester::{ABOVE_RESONANCE, BELOW_RESONANCE, PaperCase};
use crate::impact::{Impact, LONG_RUN_S};
use crate::named::column;
use crate::{NamedTable, ReproduceError};
use jounce_analysis::run::RunResult;
use jounce_io::table::Table;
use jounce_model::linear::steady_power_w;

/// Run of a case, with its power without impact.
struct PaperRun<'r> {
    case: PaperCase,
    duration_s: f64,
    result: &'r RunResult,
    linear_w: f64,
}

/// Returns both runs, and the first run continued to steady state.
fn runs(computed: &Impact) -> Result<Vec<PaperRun<'_>>, ReproduceError> {
    let duration_s = computed.harvester.spec.run.duration_s;
    let runs = [
        (ABOVE_RESONANCE, duration_s, &computed.voltage.result),
        (ABOVE_RESONANCE, LONG_RUN_S, &computed.long_run),
        (BELOW_RESONANCE, duration_s, &computed.below_run),
    ];
    let runs = runs.into_iter().map(|(case, duration_s, result)| {
        Ok(PaperRun {
            case,
            duration_s,
            result,
            linear_w: steady_power_w(&computed.harvester.plant(case)?),
        })
    });
    runs.collect()
}

/// Returns the table of both runs, and of the first run continued to steady state.
pub(crate) fn table(computed: &Impact) -> Result<NamedTable, ReproduceError> {
    let runs = runs(computed)?;
    let table = Table::new(vec![
        column(&runs, ("frequency_hz", "Hz", "Drive"), |run| {
            run.case.frequency_hz
        }),
        column(&runs, ("amplitude_n", "N", "Force, peak"), |run| {
            run.case.amplitude_n
        }),
        column(&runs, ("duration_s", "s", "Duration"), |run| run.duration_s),
        column(
            &runs,
            ("power_w_n2", "W/N^2", "Mean power per force squared"),
            |run| run.case.normalised(run.result.mean_power_w),
        ),
        column(
            &runs,
            ("linear_power_w_n2", "W/N^2", "Without impact"),
            |run| run.case.normalised(run.linear_w),
        ),
        column(&runs, ("mean_power_w", "W", "Mean power"), |run| {
            run.result.mean_power_w
        }),
        column(&runs, ("voltage_rms_v", "V", "Voltage, rms"), |run| {
            run.result
                .loads
                .iter()
                .map(|load| load.voltage_rms_v)
                .sum::<f64>()
        }),
        column(
            &runs,
            ("max_penetration_m", "m", "Penetration, peak"),
            |run| run.result.max_penetration_m,
        ),
        column(&runs, ("contacts", "", "Contacts in 10 s"), |run| {
            run.result.contacts
        }),
        column(&runs, ("settled", "", "Settled"), |run| {
            run.result.settlement.is_some_and(|found| found.settled)
        }),
    ])?;
    Ok(NamedTable::new(
        "runs",
        "Runs from rest at 1 MΩ, averaged over their last 10 s.",
        4,
        table,
    ))
}
