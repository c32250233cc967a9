//! One integration of an ensemble.

use super::contacts::{ContactCount, MemberStop};
use super::devices::{DeviceCounts, MemberDevice};
use crate::run::{ExceededLimit, Limits, RunPlan, StartState, WorstExcess};
use jounce_dynamics::{
    ContactStatistics, Energies, IntegrationError, Integrator, Kernel, Trajectory,
};
use serde::Serialize;

/// Batches into which the averaging window of a member is cut.
pub(super) const BATCHES: usize = 16;

/// Results of one realisation over its averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Member {
    /// Number of the realisation under its seed.
    #[serde(rename = "id")]
    pub index: usize,
    /// Total mean power of all loads and rectified circuits, W.
    pub mean_power_w: f64,
    /// Mean power of each load, then of each rectified circuit, W.
    pub loads_w: Vec<f64>,
    /// Mean power in each batch of the window, W.
    pub batches_w: Vec<f64>,
    /// Contacts that began.
    pub contacts: u64,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// Mean impact velocity, m/s; 0 without contact.
    pub mean_impact_velocity_m_s: f64,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean duration of a contact, s; 0 without contact.
    pub mean_contact_duration_s: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Results of each stop.
    pub stops: Vec<MemberStop>,
    /// Operation of each device behind a regulator.
    pub devices: Vec<MemberDevice>,
    /// Energy residual of the entire integration over its largest energy.
    pub energy_residual_relative: f64,
    /// Limits of patches that are exceeded.
    #[serde(rename = "warnings")]
    pub exceeded: Vec<ExceededLimit>,
}

/// Voltages of the patches of a member, sampled over its averaging window.
#[derive(Debug, Clone)]
pub(super) struct Sampling {
    /// Samples in each batch.
    pub per_batch: usize,
    /// Samples of each patch.
    pub voltages_v: Vec<Vec<f64>>,
}

impl Member {
    /// Integrates a realisation and fills `sampling` where it is given.
    pub(super) fn integrate(
        kernel: &Kernel,
        limits: &Limits,
        start: &StartState,
        plan: &RunPlan,
        index: usize,
        mut sampling: Option<&mut Sampling>,
    ) -> Result<Self, IntegrationError> {
        let window_s = plan.average_over_s;
        let mut integrator = at_window(kernel, start, plan)?;
        let opened = integrator.energies();
        let mut stops = vec![
            (ContactCount::default(), Vec::with_capacity(BATCHES));
            kernel.plant.system.stops.len()
        ];
        let (mut batches_w, mut before_j) = (Vec::with_capacity(BATCHES), opened.delivered_j());
        let mut devices = DeviceCounts::open(&kernel.plant, &integrator, &opened);
        let mut exceeded_per_batch: Vec<Vec<ExceededLimit>> = Vec::new();
        for batch in 1..=BATCHES {
            let ends_s = [batch - 1, batch].map(|batch| batch_end_s(plan, batch));
            let records = sampling.is_some() || !limits.is_empty();
            if records {
                integrator.start_record();
            }
            integrator.advance_to(ends_s[1])?;
            if records {
                let record = integrator.take_record();
                exceeded_per_batch.push(limits.exceeded(kernel, &record, f64::INFINITY));
                if let Some(sampling) = sampling.as_deref_mut() {
                    sampling.read(kernel, &record, ends_s);
                }
            }
            let energies = integrator.energies();
            devices.close(&kernel.plant, &integrator, &energies);
            let now_j = energies.delivered_j();
            batches_w.push((now_j - before_j) * BATCHES as f64 / window_s);
            before_j = now_j;
            for ((before, counts), now) in stops.iter_mut().zip(integrator.statistics_by_stop()) {
                let count = ContactCount::since(&now, before);
                *before = before.and(&count);
                counts.push(count);
            }
        }
        let counts = stops.into_iter().map(|(_, counts)| counts);
        let stops = counts
            .zip(integrator.statistics_by_stop())
            .map(|(batches, statistics)| member_stop(batches, &statistics))
            .collect();
        let exceeded = WorstExcess::of(exceeded_per_batch.iter().map(Vec::as_slice))
            .into_iter()
            .map(|worst| worst.exceeded)
            .collect();
        let member = Self::from_statistics(
            index,
            window_s,
            [&opened, &integrator.energies()],
            (batches_w, stops),
            &integrator.statistics(),
        );
        Ok(Self {
            exceeded,
            devices: devices.members(&integrator),
            ..member
        })
    }

    fn from_statistics(
        index: usize,
        window_s: f64,
        [opened, energies]: [&Energies; 2],
        (batches_w, stops): (Vec<f64>, Vec<MemberStop>),
        statistics: &ContactStatistics,
    ) -> Self {
        let loads_w: Vec<f64> = energies
            .delivered_per_element_j()
            .zip(opened.delivered_per_element_j())
            .map(|(end, start)| (end - start) / window_s)
            .collect();
        Self {
            index,
            mean_power_w: loads_w.iter().fold(0.0, |sum, energy| sum + energy),
            loads_w,
            batches_w,
            contacts: statistics.contacts,
            contact_rate_hz: statistics.contacts as f64 / window_s,
            mean_impact_velocity_m_s: statistics.mean_impact_velocity_m_s(),
            max_impact_velocity_m_s: statistics.max_impact_velocity_m_s,
            mean_contact_duration_s: statistics.mean_contact_duration_s(),
            max_penetration_m: statistics.max_penetration_m,
            stops,
            devices: Vec::new(),
            energy_residual_relative: energies.residual_relative(),
            exceeded: Vec::new(),
        }
    }
}

/// Returns the integration of a start at the beginning of its averaging window.
fn at_window<'k>(
    kernel: &'k Kernel,
    start: &StartState,
    plan: &RunPlan,
) -> Result<Integrator<'k>, IntegrationError> {
    let mut integrator = Integrator::new(
        kernel,
        &kernel.plant.from_physical(&start.physical(), 0.0),
        0.0,
        plan.tolerance,
    )?;
    integrator.advance_to(plan.duration_s - plan.average_over_s)?;
    integrator.reset_statistics();
    Ok(integrator)
}

/// Returns the end of a batch of the averaging window, s.
fn batch_end_s(plan: &RunPlan, batch: usize) -> f64 {
    if batch == BATCHES {
        plan.duration_s
    } else {
        let begin_s = plan.duration_s - plan.average_over_s;
        begin_s + plan.average_over_s * batch as f64 / BATCHES as f64
    }
}

fn member_stop(batches: Vec<ContactCount>, statistics: &ContactStatistics) -> MemberStop {
    MemberStop {
        batches,
        max_impact_velocity_m_s: statistics.max_impact_velocity_m_s,
        max_contact_duration_s: statistics.max_contact_duration_s,
        max_contact_force_n: statistics.max_force_n,
        max_penetration_m: statistics.max_penetration_m,
    }
}

impl Sampling {
    /// Reads a recorded batch.
    fn read(&mut self, kernel: &Kernel, record: &Trajectory, [from_s, to_s]: [f64; 2]) {
        let times_s: Vec<f64> = (0..self.per_batch)
            .map(|k| from_s + (to_s - from_s) * k as f64 / self.per_batch as f64)
            .collect();
        for at in record.at(kernel, &times_s) {
            let voltages = kernel
                .plant
                .patch_voltages_v(&kernel.plant.to_physical(&at.state, at.time_s));
            self.voltages_v
                .iter_mut()
                .zip(voltages)
                .for_each(|(samples, voltage)| samples.push(voltage));
        }
    }
}
