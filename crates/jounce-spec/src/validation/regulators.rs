//! Regulators and devices: every one is used, and its values fit each other.

use super::ValidationFaults;
use super::reference::unknown;
use crate::{Circuit, Device, Regulator, Spec};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    for (name, circuit) in &spec.circuit {
        check_references(spec, name, circuit, faults);
    }
    for (name, regulator) in &spec.regulator {
        check_regulator(name, regulator, faults);
        if !spec
            .circuit
            .values()
            .any(|circuit| circuit.regulator == *name)
        {
            let text = "no circuit names this regulator; name it in `regulator` of a [circuit.NAME] with a storage, or omit it";
            faults.push(|| format!("regulator.{name}"), || text.to_owned());
        }
    }
    for (name, device) in &spec.device {
        check_device(name, device, faults);
        if !spec.circuit.values().any(|circuit| circuit.device == *name) {
            let text = "no circuit names this device; name it in `device` of a [circuit.NAME] with a regulator, or omit it";
            faults.push(|| format!("device.{name}"), || text.to_owned());
        }
    }
}

fn check_references(spec: &Spec, name: &str, circuit: &Circuit, faults: &mut ValidationFaults) {
    let (regulator, device) = (&circuit.regulator, &circuit.device);
    if !regulator.is_empty() && !spec.regulator.contains_key(regulator) {
        let text = || {
            let known: Vec<&str> = spec.regulator.keys().map(String::as_str).collect();
            unknown("regulator", regulator, "regulators", &known)
        };
        faults.push(|| format!("circuit.{name}.regulator"), text);
    }
    if !device.is_empty() && !spec.device.contains_key(device) {
        let text = || {
            let known: Vec<&str> = spec.device.keys().map(String::as_str).collect();
            unknown("device", device, "devices", &known)
        };
        faults.push(|| format!("circuit.{name}.device"), text);
    }
    let unfit = [
        (
            !regulator.is_empty() && device.is_empty(),
            "regulator",
            "supplies no device; give `device`, the name of a [device.NAME]",
        ),
        (
            regulator.is_empty() && !device.is_empty(),
            "device",
            "has no regulator; give `regulator` in place of `resistance` or `battery`, or omit the device",
        ),
        (
            !regulator.is_empty() && circuit.battery_v.is_some(),
            "regulator",
            "has no effect with a battery, whose voltage is fixed; give `storage` instead of `battery`, or omit it",
        ),
    ];
    for (is_unfit, key, text) in unfit {
        if is_unfit {
            faults.push(|| format!("circuit.{name}.{key}"), || text.to_owned());
        }
    }
}

fn check_regulator(name: &str, regulator: &Regulator, faults: &mut ValidationFaults) {
    let (start_v, stop_v, output_v) = (regulator.start_v, regulator.stop_v, regulator.output_v);
    if start_v <= stop_v {
        faults.push(
            || format!("regulator.{name}.start_voltage"),
            || {
                format!(
                    "{start_v} V must be above the stop voltage of {stop_v} V: the regulator starts at the higher voltage and stops at the lower"
                )
            },
        );
    }
    if stop_v < output_v {
        faults.push(
            || format!("regulator.{name}.stop_voltage"),
            || {
                format!(
                    "{stop_v} V must be at least the output voltage of {output_v} V: the converter steps the voltage down"
                )
            },
        );
    }
}

fn check_device(name: &str, device: &Device, faults: &mut ValidationFaults) {
    let pairs = [
        ("measure", device.measure_a, device.measure_s),
        ("send", device.send_a, device.send_s),
    ];
    for (what, current_a, time_s) in pairs {
        let (given, missing) = match (current_a, time_s) {
            (Some(_), None) => ("current", "time"),
            (None, Some(_)) => ("time", "current"),
            _ => continue,
        };
        faults.push(
            || format!("device.{name}.{what}_{given}"),
            || format!("is given without `{what}_{missing}`; give both, or none"),
        );
    }
    let busy_s = device.measure_s.unwrap_or(0.0) + device.send_s.unwrap_or(0.0);
    match device.period_s {
        None if busy_s > 0.0 => faults.push(
            || format!("device.{name}"),
            || "measures or sends without a `period`; give the time from one measurement to the next".to_owned(),
        ),
        Some(period_s) if busy_s >= period_s => faults.push(
            || format!("device.{name}.period"),
            || format!("{period_s} s must be longer than measuring and sending together, {busy_s} s"),
        ),
        Some(_) if busy_s == 0.0 => faults.push(
            || format!("device.{name}.period"),
            || "has no effect on a device that neither measures nor sends; omit it, or give `measure_current` and `measure_time`".to_owned(),
        ),
        _ => {}
    }
}
