//! The result of a run as lines of text.

use crate::output::{counted, line, power};
use jounce::RunResult;
use jounce::parts::{ChargeResult, DeviceResult, LoadResult, RectifiedResult, StopResult};

/// Prints the result as lines of text.
pub(super) fn print_lines(result: &RunResult) {
    line(format!(
        "mean power         {} W",
        power(result.mean_power_w)
    ));
    print_voltages(result);
    for circuit in &result.rectified {
        print_storage(result, circuit);
    }
    print_motion(result);
    for device in &result.devices {
        print_device(device);
    }
    for leak in &result.leaks {
        line(format!(
            "leakage            {} W  (patch {})",
            power(leak.mean_power_w),
            leak.name
        ));
    }
    print_contacts(result);
    print_quality(result);
    line(format!(
        "computed in        {}, {} flight and {} contact steps",
        wall_time(result.wall_time_s),
        result.work.flight_steps,
        result.work.contact_steps
    ));
}

/// Returns a wall time as text with its unit.
fn wall_time(time_s: f64) -> String {
    match time_s < 1.0 {
        true => format!("{:.3} ms", 1e3 * time_s),
        false => format!("{time_s:.3} s"),
    }
}

/// Prints the storage of a rectified circuit with its powers and charges.
fn print_storage(result: &RunResult, circuit: &RectifiedResult) {
    // Synchronous extraction transfers energy, without a charge through diodes.
    let current = if circuit.mean_current_a == 0.0 {
        String::new()
    } else {
        format!(", mean current {:.4e} A", circuit.mean_current_a)
    };
    line(format!(
        "storage, rms       {:.6} V{current}  (circuit {})",
        circuit.voltage_rms_v, circuit.name
    ));
    // A loss of zero may have roundoff of either sign.
    let [diodes, switch, leakage, regulator] = [
        circuit.diode_loss_w,
        circuit.switch_loss_w,
        circuit.leakage_w,
        circuit.regulator_loss_w,
    ]
    .map(|loss_w| power(loss_w.max(0.0)));
    line(format!(
        "  delivered        {} W, filling the storage {} W",
        power(circuit.mean_power_w),
        power(circuit.storage_w)
    ));
    let regulator = match result.devices.iter().any(|own| own.name == circuit.name) {
        true => format!(", regulator {regulator} W"),
        false => String::new(),
    };
    line(format!(
        "  lost             diodes {diodes} W, switch {switch} W, leakage {leakage} W{regulator}"
    ));
    result
        .charges
        .iter()
        .filter(|charge| charge.name == circuit.name)
        .for_each(print_charge);
}

/// Prints the operation of a device.
fn print_device(device: &DeviceResult) {
    let cold_start = match device.cold_start_s {
        Some(time_s) => format!("first start at {time_s:.6} s"),
        None => "never starts".to_owned(),
    };
    line(format!(
        "device             on for {:.2} % of the time, {cold_start}  (circuit {})",
        100.0 * device.on_fraction,
        device.name
    ));
    line(format!(
        "  outages          longest {:.6} s, {}",
        device.longest_outage_s,
        counted(device.starts, "start")
    ));
    line(format!(
        "  tasks            {} completed, {} interrupted",
        device.completed_tasks, device.interrupted_tasks
    ));
    line(format!(
        "  energy           {:.4e} J per day; available {} W, needed {} W, margin {} W",
        device.energy_per_day_j,
        power(device.available_w),
        power(device.needed_w),
        power(device.margin_w)
    ));
}

/// Prints the contacts of all stops, then those of each stop.
fn print_contacts(result: &RunResult) {
    if !result.stops.is_empty() {
        // Contact times of several stops may overlap, so their shares are not added.
        let share = if result.stops.len() == 1 {
            format!(", {:.2} % of the time", 100.0 * result.contact_duty)
        } else {
            String::new()
        };
        line(format!(
            "contacts           {} in {} s{share}",
            result.contacts, result.average_over_s
        ));
        line(format!(
            "penetration, peak  {:.6e} m, force {:.4e} N",
            result.max_penetration_m, result.max_contact_force_n
        ));
    }
    for stop in &result.stops {
        print_stop(stop, result.stops.len() > 1);
    }
}

/// Prints the energy residual, and whether the response has settled.
fn print_quality(result: &RunResult) {
    match result.is_trivial {
        true => line(
            "energy             zero: no contact began, and no energy changed by more than roundoff",
        ),
        false => line(format!(
            "energy residual    {:.1e} of the largest energy",
            result.energy_residual_relative
        )),
    }
    let change = result.periodicity_change.unwrap_or(f64::INFINITY);
    match (result.settled, result.period_cycles) {
        (Some(true), Some(cycles)) => line(format!(
            "settled            period of {}, change {change:.1e}",
            counted(cycles, "drive cycle")
        )),
        (Some(_), _) if change.is_infinite() => {
            line("NOT settled        run.duration is too short to compare two periods; increase it")
        }
        (Some(_), _) => line(format!(
            "NOT settled        change over a period {change:.1e}; increase run.duration; a chaotic or quasi-periodic motion never settles, see `jounce basins`"
        )),
        (None, _) if !result.devices.is_empty() => line(
            "no period          a regulator switches at its own times, so there is no periodic steady state",
        ),
        (None, _) => line(
            "no period          no drives with a common period, so there is no periodic steady state",
        ),
    }
}

/// Prints the voltages of the loads, and the largest voltage of each patch without a load.
fn print_voltages(result: &RunResult) {
    for load in &result.loads {
        line(format!(
            "voltage, rms       {:.6} V  (load {})",
            load.voltage_rms_v, load.name
        ));
        match load.voltage_peak_v {
            Some(peak_v) => line(format!("voltage, peak      {peak_v:.6} V")),
            None if result.settled.is_some() => line(
                "voltage, peak      not recorded: run.average_over has too many drive cycles; decrease it",
            ),
            None => {}
        }
    }
    for patch in &result.patches {
        let across_load = |load: &LoadResult| load.voltage_peak_v == patch.voltage_peak_v;
        if let Some(peak_v) = patch.voltage_peak_v
            && !result.loads.iter().any(across_load)
        {
            line(format!(
                "voltage, peak      {peak_v:.6} V  (patch {})",
                patch.name
            ));
        }
    }
}

/// Prints the largest displacement of each point and the largest strain of each patch.
fn print_motion(result: &RunResult) {
    for point in &result.points {
        if let Some(peak_m) = point.displacement_peak_m {
            line(format!(
                "displacement, peak {peak_m:.6e} m  (point {})",
                point.name
            ));
        }
    }
    for patch in &result.patches {
        if let Some(peak) = patch.strain_peak {
            line(format!(
                "strain, peak       {:.2} ppm  (patch {})",
                1e6 * peak,
                patch.name
            ));
        }
    }
}

/// Prints the charge balance of a circuit and its residual.
fn print_charge(charge: &ChargeResult) {
    let ChargeResult {
        passed_c,
        load_c,
        leakage_c,
        storage_c,
        residual_relative,
        ..
    } = charge;
    line(format!(
        "  charge           diodes {passed_c:.4e} C = load {load_c:.4e} + leakage {leakage_c:.4e} + storage {storage_c:.4e} C"
    ));
    line(format!(
        "  charge residual  {residual_relative:.1e} of the largest charge"
    ));
}

/// Prints the contacts of one stop; of `several` also the values that `print_lines` prints of a
/// single stop.
fn print_stop(stop: &StopResult, is_labelled: bool) {
    if is_labelled {
        let (contacts, depth, force) = (
            stop.contacts,
            stop.max_penetration_m,
            stop.max_contact_force_n,
        );
        let share = 100.0 * stop.contact_duty;
        line(format!(
            "  stop {:<12}  {}, {share:.2} % of the time, penetration {depth:.6e} m, force {force:.4e} N",
            stop.name,
            counted(contacts, "contact")
        ));
    }
    if stop.contacts > 0 {
        line(format!(
            "  impact velocity  {:.4e} m/s in the mean, {:.4e} m/s at most",
            stop.mean_impact_velocity_m_s, stop.max_impact_velocity_m_s
        ));
    }
    if stop.contacts > 0 && !stop.is_rigid {
        line(format!(
            "  contact duration {:.4e} s in the mean, {:.4e} s at most",
            stop.mean_contact_duration_s, stop.max_contact_duration_s
        ));
    }
}
