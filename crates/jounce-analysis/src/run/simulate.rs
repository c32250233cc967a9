//! Time integration of a run and collection of its results.

use super::device::devices;
use super::error::{check, check_outside};
use super::settle::{Noise, STROBE_STATES, repeated_window_s, settled};
use super::{
    LeakResult, LoadResult, RectifiedResult, RunError, RunPlan, RunResult, StartState, StopResult,
};
use jounce_dynamics::{
    ContactStatistics, DeviceStatistics, Energies, IntegrationError, Integrator, Kernel,
    RectifiedEnergies,
};
use jounce_model::contact::Law;
use jounce_model::plant::{Bridge, Leak, Plant, Storage};
use std::time::Instant;

/// Integrates from an initial state.
///
/// The drives of `kernel` must start at the angles of the state (see [`super::StartState`] and
/// [`Kernel::with_drives`]).
///
/// # Errors
/// [`RunError`].
pub fn simulate(
    kernel: &Kernel,
    start: &StartState,
    plan: &RunPlan,
) -> Result<RunResult, RunError> {
    let plant = &kernel.plant;
    check(plant, start)?;
    check_outside(plant, &start.displacement)?;
    let clock = Instant::now();
    let y = plant.from_physical(&start.physical(), 0.0);
    let mut integrator = Integrator::new(kernel, &y, 0.0, plan.tolerance)?;
    let end_s = plan.duration_s;
    let window_s = end_s - plan.average_over_s;
    let period_s = plant.period_s();
    let strobe_time_s = period_s.map_or(0.0, |period_s| (STROBE_STATES - 1) as f64 * period_s);
    let record_s = end_s - plan.record_s.max(strobe_time_s).min(end_s);
    let opened = advance_to_window(&mut integrator, plant, start, [window_s, record_s])?;
    integrator.advance_to(end_s)?;
    let wall_time = clock.elapsed();
    kernel.control.add_wall_time(wall_time);
    let trajectory = integrator.take_record();
    let noise = Noise::of(&integrator, plan.tolerance);
    let settlement = period_s.map(|period_s| settled(kernel, &trajectory, end_s, period_s, noise));
    let window = (&opened.state, window_s, end_s);
    let peak_window_s = repeated_window_s(kernel, &trajectory, window, settlement.as_ref());
    let energies = integrator.energies();
    let statistics = integrator.statistics();
    let loads = loads(plant, [&opened.energies, &energies], plan.average_over_s);
    let end = StartState::from_blocks(plant, &integrator.state(), end_s);
    let rectified = rectified(
        plant,
        [(&opened.energies, &opened.state), (&energies, &end)],
        plan.average_over_s,
    );
    let statistics_of_devices = integrator.device_statistics();
    let drawn_c = |statistics: &Option<DeviceStatistics>| statistics.map_or(0.0, |it| it.drawn_c);
    let devices = devices(
        plant,
        &statistics_of_devices,
        &rectified,
        plan.average_over_s,
    );
    Ok(RunResult {
        mean_power_w: mean_power_w(&loads, &rectified),
        loads,
        rectified,
        devices,
        drawn_c: statistics_of_devices.iter().map(drawn_c).collect(),
        leaks: leaks(plant, [&opened.energies, &energies], plan.average_over_s),
        stops: stops(plant, &integrator, plan.average_over_s),
        max_penetration_m: statistics.max_penetration_m,
        max_contact_force_n: statistics.max_force_n,
        contacts: statistics.contacts,
        contacts_in_all: opened.contacts + statistics.contacts,
        contact_duty: statistics.time_s / plan.average_over_s,
        settlement,
        peak_window_s,
        energies,
        work: integrator.work(),
        end,
        wall_time_s: wall_time.as_secs_f64(),
        trajectory,
    })
}

/// Values at the start of the averaging window.
struct WindowStart {
    energies: Energies,
    state: StartState,
    /// Contacts before the window.
    contacts: u64,
}

/// Integrates to the start of the averaging window and to that of the record, the earlier one
/// first.
fn advance_to_window(
    integrator: &mut Integrator,
    plant: &Plant,
    start: &StartState,
    [window_s, record_s]: [f64; 2],
) -> Result<WindowStart, IntegrationError> {
    let mut opened = WindowStart {
        energies: Energies::default(),
        state: start.clone(),
        contacts: 0,
    };
    let mut marks = [(window_s, true), (record_s, false)];
    marks.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (time_s, is_window) in marks {
        integrator.advance_to(time_s)?;
        if is_window {
            opened.contacts = integrator.statistics().contacts;
            integrator.reset_statistics();
            opened.energies = integrator.energies();
            opened.state = StartState::from_blocks(plant, &integrator.state(), time_s);
        } else {
            integrator.start_record();
        }
    }
    Ok(opened)
}

fn mean_power_w(loads: &[LoadResult], rectified: &[RectifiedResult]) -> f64 {
    let powers = loads
        .iter()
        .map(|load| load.mean_power_w)
        .chain(rectified.iter().map(|power_w| power_w.mean_power_w));
    powers.fold(0.0, |sum, power_w| sum + power_w)
}

fn loads(plant: &Plant, ends: [&Energies; 2], average_over_s: f64) -> Vec<LoadResult> {
    (plant
        .system
        .loads
        .iter()
        .zip(ends[1].loads_j.iter().zip(&ends[0].loads_j)))
    .map(|(load, (end, start))| {
        let mean_power_w = (end - start) / average_over_s;
        LoadResult {
            name: load.name.clone(),
            mean_power_w,
            voltage_rms_v: (mean_power_w * load.resistance_ohm).max(0.0).sqrt(),
        }
    })
    .collect()
}

fn rectified(
    plant: &Plant,
    ends: [(&Energies, &StartState); 2],
    average_over_s: f64,
) -> Vec<RectifiedResult> {
    let result = |(k, bridge): (usize, &Bridge)| {
        let change = |of: &dyn Fn(&Energies, &StartState) -> f64| {
            of(ends[1].0, ends[1].1) - of(ends[0].0, ends[0].1)
        };
        let mean = |of: fn(&RectifiedEnergies) -> f64| {
            change(&|energies, _| energies.rectified.get(k).map_or(0.0, of)) / average_over_s
        };
        let mean_power_w = mean(RectifiedEnergies::delivered_j);
        // The conductance across the storage draws its power from the square of the voltage.
        let conductance_w = match bridge.regulator() {
            Some(_) => mean(|of_bridge| of_bridge.idle_j),
            None => mean_power_w,
        };
        let storage = plant.electrical.bridges[k].storage;
        let (voltage_rms_v, storage_w) = match (bridge.storage, storage) {
            (Storage::Battery { voltage_v }, _) => (voltage_v, 0.0),
            (of_bridge, Some(node)) => {
                let capacitance_f = of_bridge.capacitance_f().unwrap_or(f64::NAN);
                let stored_j =
                    change(&|_, state| 0.5 * capacitance_f * state.voltage_v[node].powi(2));
                let square_v2 = conductance_w / of_bridge.conductance_per_ohm();
                (square_v2.max(0.0).sqrt(), stored_j / average_over_s)
            }
            (_, None) => (f64::NAN, f64::NAN),
        };
        RectifiedResult {
            name: bridge.name.clone(),
            mean_power_w,
            voltage_rms_v,
            mean_current_a: mean(|of_bridge| of_bridge.charge_c),
            storage_w,
            diode_loss_w: mean(|of_bridge| of_bridge.diodes_j),
            switch_loss_w: mean(|of_bridge| of_bridge.switch_j),
            leakage_w: mean(|of_bridge| of_bridge.leakage_j),
            regulator_loss_w: mean(|of_bridge| of_bridge.regulator_j),
        }
    };
    plant
        .system
        .bridges
        .iter()
        .enumerate()
        .map(result)
        .collect()
}

fn leaks(plant: &Plant, [start, end]: [&Energies; 2], average_over_s: f64) -> Vec<LeakResult> {
    let names: Vec<&String> = plant.system.modes.patch.keys().collect();
    let losses = start
        .leaks_j
        .iter()
        .zip(&end.leaks_j)
        .map(|(start, end)| (end - start) / average_over_s);
    let result = |(leak, mean_power_w): (&Leak, f64)| LeakResult {
        name: names[leak.patch].clone(),
        mean_power_w,
    };
    plant
        .electrical
        .leaks
        .iter()
        .zip(losses)
        .map(result)
        .collect()
}

fn stops(plant: &Plant, integrator: &Integrator, average_over_s: f64) -> Vec<StopResult> {
    let result = |(stop, statistics): (&jounce_model::plant::Stop, ContactStatistics)| StopResult {
        name: stop.name.clone(),
        is_rigid: matches!(stop.law, Law::Rigid(_)),
        contacts: statistics.contacts,
        contact_rate_hz: statistics.contacts as f64 / average_over_s,
        mean_impact_velocity_m_s: statistics.mean_impact_velocity_m_s(),
        max_impact_velocity_m_s: statistics.max_impact_velocity_m_s,
        mean_contact_duration_s: statistics.mean_contact_duration_s(),
        max_contact_duration_s: statistics.max_contact_duration_s,
        contact_duty: statistics.time_s / average_over_s,
        max_penetration_m: statistics.max_penetration_m,
        max_contact_force_n: statistics.max_force_n,
        impulse_n_s: statistics.impulse_n_s,
    };
    plant
        .system
        .stops
        .iter()
        .zip(integrator.statistics_by_stop())
        .map(result)
        .collect()
}
