//! Operation of the devices behind regulators. Of several devices each measure is that of the
//! device for which it is worst.

use super::measure::{Measure, number};
use crate::DeviceEstimates;
use crate::run::DeviceResult;
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
    worst(devices.iter().map(|device| {
        [
            device.on_fraction,
            device.cold_start_s.unwrap_or(f64::INFINITY),
            device.longest_outage_s,
            device.margin_w,
        ]
    }))
}

/// Returns the values over an ensemble.
pub(super) fn of_ensemble(devices: &[DeviceEstimates], members: usize) -> Vec<f64> {
    worst(devices.iter().map(|device| {
        let starts = device.never_started < members;
        [
            device.on_fraction.mean,
            if starts {
                device.cold_start_s.mean
            } else {
                f64::INFINITY
            },
            device.longest_outage_s,
            device.margin_w.mean,
        ]
    }))
}

fn worst(devices: impl Iterator<Item = [f64; 4]>) -> Vec<f64> {
    let both = |a: [f64; 4], b: [f64; 4]| {
        [
            a[0].min(b[0]),
            a[1].max(b[1]),
            a[2].max(b[2]),
            a[3].min(b[3]),
        ]
    };
    devices.reduce(both).map_or_else(Vec::new, Vec::from)
}
