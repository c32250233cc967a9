//! Time integration of a run and collection of its results.

use super::settle::{STROBE_STATES, norm, settlement};
use super::{
    LeakResult, Limits, LoadResult, RectifiedResult, RunResult, Settlement, StartState, StopResult,
};
use jounce_dynamics::{
    ContactStatistics, Energies, IntegrationError, Integrator, Kernel, RectifiedEnergies,
};
use jounce_model::contact::Law;
use jounce_model::plant::{Bridge, Leak, Plant, Storage};
use jounce_spec::{Run, Spec};
use std::time::Instant;

/// Relative displacement by which an initial state may lie inside a rigid stop: saved states are
/// rounded.
const START_ROUNDOFF: f64 = 1e-9;

/// Motion, relative to the forced response without contact, below which a body counts as at rest.
const REST_MOTION_SHARE: f64 = 1e-9;

/// Duration, averaging window, tolerance and record of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunPlan {
    /// Length of the run, s.
    pub duration_s: f64,
    /// Length of the averaging window at the end of the run, s.
    pub average_over_s: f64,
    /// Requested relative error of the response.
    pub tolerance: f64,
    /// Length of the record at the end of the run, s; 0 for no record.
    pub record_s: f64,
}

impl RunPlan {
    /// Returns the plan of `[run]` of a spec, with a record of the last `record_s` seconds.
    #[must_use]
    pub fn of(run: &Run, record_s: f64) -> Self {
        Self {
            duration_s: run.duration_s,
            average_over_s: run.average_over_s,
            tolerance: run.tolerance,
            record_s,
        }
    }

    /// Returns the plan with a record of the averaging window, if a patch has limits and the drives
    /// have no common period.
    #[must_use]
    pub fn watching(self, spec: &Spec, plant: &Plant) -> Self {
        let records = plant.period_s().is_none() && !Limits::of(spec, plant).is_empty();
        Self {
            record_s: if records {
                self.record_s.max(self.average_over_s)
            } else {
                self.record_s
            },
            ..self
        }
    }

    /// Returns the plan with a record of the averaging window, if a rectifier feeds a capacitor;
    /// for [`super::charges`].
    #[must_use]
    pub fn balancing(self, plant: &Plant) -> Self {
        let fed = plant
            .system
            .bridges
            .iter()
            .any(|bridge| matches!(bridge.storage, Storage::Capacitor { .. }));
        Self {
            record_s: if fed {
                self.record_s.max(self.average_over_s)
            } else {
                self.record_s
            },
            ..self
        }
    }
}

/// Failure of a run.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum RunError {
    /// See [`IntegrationError`].
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The start state does not fit the harvester.
    #[error(
        "the start state has {modes} modes, {patches} electrical states and {drives} drives, or a value that is not finite; this harvester has {wanted_modes} modes, {wanted_patches} electrical states and {wanted_drives} drives"
    )]
    StateDoesNotFit {
        /// Modes of the state.
        modes: usize,
        /// Patches of the state.
        patches: usize,
        /// Drives of the state.
        drives: usize,
        /// Modes of the harvester.
        wanted_modes: usize,
        /// Patches of the harvester.
        wanted_patches: usize,
        /// Drives of the harvester.
        wanted_drives: usize,
    },
    /// The run starts inside a rigid stop.
    #[error(
        "stop.{stop}.gap: the run starts {depth_m:e} m inside this stop, and nothing enters a rigid one; give a larger gap, a run.start outside it, or a law that yields"
    )]
    StartsInside {
        /// Name of the stop.
        stop: String,
        /// Depth inside the stop, m.
        depth_m: f64,
    },
    /// The plant cannot be built with the drive angles of the state.
    #[error(transparent)]
    Plant(#[from] jounce_model::plant::PlantError),
}

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
    let mut opened = None;
    let mut earlier = 0;
    let mut marks = [(window_s, true), (record_s, false)];
    marks.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (time_s, is_window) in marks {
        integrator.advance_to(time_s)?;
        if is_window {
            earlier = integrator.statistics().contacts;
            integrator.reset_statistics();
            opened = Some((
                integrator.energies(),
                StartState::from_blocks(plant, &integrator.state(), time_s),
            ));
        } else {
            integrator.start_record();
        }
    }
    integrator.advance_to(end_s)?;
    let wall_time = clock.elapsed();
    kernel.control.add_wall_time(wall_time);
    let (opened, before) = opened.unwrap_or_else(|| (Energies::default(), start.clone()));
    let trajectory = integrator.take_record();
    let noise = 10.0 * plan.tolerance.max(1e-13);
    let settlement = period_s.map(|period_s| settled(kernel, &trajectory, end_s, period_s, noise));
    let energies = integrator.energies();
    let statistics = integrator.statistics();
    let loads = loads(plant, [&opened, &energies], plan.average_over_s);
    let end = StartState::from_blocks(plant, &integrator.state(), end_s);
    let rectified = rectified(
        plant,
        [(&opened, &before), (&energies, &end)],
        plan.average_over_s,
    );
    Ok(RunResult {
        mean_power_w: mean_power_w(&loads, &rectified),
        loads,
        rectified,
        leaks: leaks(plant, [&opened, &energies], plan.average_over_s),
        stops: stops(plant, &integrator, plan.average_over_s),
        max_penetration_m: statistics.max_penetration_m,
        max_contact_force_n: statistics.max_force_n,
        contacts: statistics.contacts,
        contacts_in_all: earlier + statistics.contacts,
        contact_duty: statistics.time_s / plan.average_over_s,
        settlement,
        energies,
        work: integrator.work(),
        end,
        wall_time_s: wall_time.as_secs_f64(),
        trajectory,
    })
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
        let mean_power_w = mean(|of_bridge| of_bridge.load_j + of_bridge.battery_j);
        let (voltage_rms_v, storage_w) = match (bridge.storage, plant.electrical.bridges[k].storage)
        {
            (
                Storage::Capacitor {
                    capacitance_f,
                    load_ohm,
                },
                Some(node),
            ) => {
                let stored_j =
                    change(&|_, state| 0.5 * capacitance_f * state.voltage_v[node].powi(2));
                (
                    (mean_power_w * load_ohm).max(0.0).sqrt(),
                    stored_j / average_over_s,
                )
            }
            (Storage::Battery { voltage_v }, _) => (voltage_v, 0.0),
            (Storage::Capacitor { .. }, None) => (f64::NAN, f64::NAN),
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

fn check(plant: &Plant, start: &StartState) -> Result<(), RunError> {
    if start.fits(plant) {
        return Ok(());
    }
    Err(RunError::StateDoesNotFit {
        modes: start.displacement.len(),
        patches: start.voltage_v.len() + start.current_a.len(),
        drives: start.drive_angle_rad.len(),
        wanted_modes: plant.system.modes.len(),
        wanted_patches: plant.electrical.len(),
        wanted_drives: plant.system.drives.len(),
    })
}

/// Checks that no point lies inside a rigid stop by more than roundoff.
pub fn check_outside(plant: &Plant, displacement: &[f64]) -> Result<(), RunError> {
    let stops = plant.system.stops.iter().enumerate();
    for (index, stop) in stops.filter(|(_, stop)| matches!(stop.law, Law::Rigid(_))) {
        let (along, base_m) = (
            stop.shape.iter().zip(displacement),
            plant.approached_m(index, 0.0),
        );
        let nothing = (base_m, stop.gap_m.abs() + base_m.abs());
        let (position_m, reach_m) = along.fold(nothing, |(sum, size), (s, q)| {
            (sum + s * q, size + (s * q).abs())
        });
        if position_m - stop.gap_m > START_ROUNDOFF * reach_m {
            return Err(RunError::StartsInside {
                stop: stop.name.clone(),
                depth_m: position_m - stop.gap_m,
            });
        }
    }
    Ok(())
}

/// Applies the steady-state test to the state at each period of the drives at the end of the run.
fn settled(
    kernel: &Kernel,
    trajectory: &jounce_dynamics::Trajectory,
    end_s: f64,
    period_s: f64,
    noise: f64,
) -> Settlement {
    let times: Vec<f64> = (0..STROBE_STATES)
        .rev()
        .map(|k| end_s - k as f64 * period_s)
        .filter(|time_s| *time_s > -1e-9 * period_s)
        .collect();
    let plant = &kernel.plant;
    let frequencies = &plant.system.modes.frequency_rad_s;
    let mechanical = frequencies
        .iter()
        .copied()
        .chain(std::iter::repeat_n(1.0, frequencies.len()));
    let scales: Vec<f64> = mechanical.chain(plant.electrical.energy_scale()).collect();
    let states: Vec<Vec<f64>> = (trajectory.at(kernel, &times).iter())
        .map(|at| {
            kernel
                .plant
                .to_physical(&at.state, at.time_s)
                .iter()
                .zip(&scales)
                .map(|(x, s)| x * s)
                .collect()
        })
        .collect();
    // A ball at rest on its table moves by roundoff of the forced response.
    let driven = plant.tones.iter().map(|tone| {
        let amplitude = |i: usize| {
            (0..plant.len())
                .map(|j| tone.steady[j] * plant.diagonal.to_physical[(i, j)])
                .sum::<faer::c64>()
        };
        norm((0..plant.len()).map(|i| scales[i] * amplitude(i).norm()))
    });
    settlement(
        &states,
        noise,
        REST_MOTION_SHARE * driven.fold(0.0, f64::max),
    )
}
