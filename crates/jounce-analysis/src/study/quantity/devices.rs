//! Operation of the devices behind regulators, as measures of a study.

use super::measure::{Measure, number};
use crate::DeviceEstimates;
use crate::run::{DeviceResult, WorstOperation};
use jounce_spec::Spec;

/// Returns the measures; none without a regulator.
pub(super) fn measures(spec: &Spec) -> Vec<Measure> {
    if spec
        .circuit
        .values()
        .all(|circuit| circuit.regulator.is_empty())
    {
        return Vec::new();
    }
    vec![
        number(
            "device_on_fraction",
            "",
            "share of the time that the device is on",
        ),
        number(
            "device_cold_start_s",
            "s",
            "time to the first start, over members the mean of those that start; infinite where it never starts",
        ),
        number("device_longest_outage_s", "s", "longest time off"),
        number(
            "device_margin_w",
            "W",
            "power that arrives at the storage minus the power needed to stay on",
        ),
    ]
}

/// Returns the values over one run.
pub(super) fn of_run(devices: &[DeviceResult]) -> Vec<f64> {
    values(WorstOperation::of(devices))
}

/// Returns the values over an ensemble.
pub(super) fn of_ensemble(devices: &[DeviceEstimates], members: usize) -> Vec<f64> {
    let each = |device: &DeviceEstimates| WorstOperation {
        on_fraction: device.on_fraction.mean,
        cold_start_s: match device.never_started < members {
            true => device.cold_start_s.mean,
            false => f64::INFINITY,
        },
        longest_outage_s: device.longest_outage_s,
        margin_w: device.margin_w.mean,
    };
    values(devices.iter().map(each).reduce(WorstOperation::and))
}

fn values(worst: Option<WorstOperation>) -> Vec<f64> {
    let values = |worst: WorstOperation| {
        vec![
            worst.on_fraction,
            worst.cold_start_s,
            worst.longest_outage_s,
            worst.margin_w,
        ]
    };
    worst.map_or_else(Vec::new, values)
}
