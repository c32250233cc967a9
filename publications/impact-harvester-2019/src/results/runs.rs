//! Results of the two runs behind the paper's figures 7 to 9.

use crate::harvester::{ABOVE_RESONANCE, BELOW_RESONANCE, PaperCase};
use crate::impact::{Impact, LONG_RUN_S};
use crate::{NamedTable, ReproduceError};
use jounce_analysis::run::RunResult;
use jounce_io::table::{Column, Table};
use jounce_model::linear::steady_power_w;

/// Returns the table of both runs, and of the first run continued to steady state.
pub(crate) fn table(computed: &Impact) -> Result<NamedTable, ReproduceError> {
    let duration_s = computed.harvester.spec.run.duration_s;
    let rows: [(PaperCase, f64, &RunResult); 3] = [
        (ABOVE_RESONANCE, duration_s, &computed.voltage.result),
        (ABOVE_RESONANCE, LONG_RUN_S, &computed.long_run),
        (BELOW_RESONANCE, duration_s, &computed.below_run),
    ];
    let linear_w = rows
        .iter()
        .map(|(case, ..)| Ok(steady_power_w(&computed.harvester.plant(*case)?)));
    let linear_w = linear_w.collect::<Result<Vec<f64>, ReproduceError>>()?;
    let of = |read: fn(&RunResult) -> f64| {
        rows.iter()
            .map(|(.., result)| read(result))
            .collect::<Vec<f64>>()
    };
    let normalised = |power_w: &[f64]| {
        rows.iter()
            .zip(power_w)
            .map(|((case, ..), p)| case.normalised(*p))
            .collect::<Vec<f64>>()
    };
    let case = |read: fn(&PaperCase) -> f64| {
        rows.iter()
            .map(|(case, ..)| read(case))
            .collect::<Vec<f64>>()
    };
    let power_w = of(|result| result.mean_power_w);
    let table = Table::new(vec![
        Column::new(
            "frequency_hz",
            "Hz",
            "Drive",
            case(|case| case.frequency_hz),
        ),
        Column::new(
            "amplitude_n",
            "N",
            "Force, peak",
            case(|case| case.amplitude_n),
        ),
        Column::new(
            "duration_s",
            "s",
            "Duration",
            rows.iter()
                .map(|(_, duration_s, _)| *duration_s)
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "power_w_n2",
            "W/N^2",
            "Mean power per force squared",
            normalised(&power_w),
        ),
        Column::new(
            "linear_power_w_n2",
            "W/N^2",
            "Without impact",
            normalised(&linear_w),
        ),
        Column::new("mean_power_w", "W", "Mean power", power_w),
        Column::new(
            "voltage_rms_v",
            "V",
            "Voltage, rms",
            of(|result| result.loads.iter().map(|load| load.voltage_rms_v).sum()),
        ),
        Column::new(
            "max_penetration_m",
            "m",
            "Penetration, peak",
            of(|result| result.max_penetration_m),
        ),
        Column::new(
            "contacts",
            "",
            "Contacts in 10 s",
            rows.iter()
                .map(|(.., result)| result.contacts)
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "settled",
            "",
            "Settled",
            rows.iter()
                .map(|(.., result)| result.settlement.is_some_and(|found| found.settled))
                .collect::<Vec<_>>(),
        ),
    ])?;
    Ok(NamedTable::new(
        "runs",
        "Runs from rest at 1 MΩ, averaged over their last 10 s.",
        4,
        table,
    ))
}
