//! One march of an ensemble.

use crate::march::{Kernel, MarchError, Marcher};
use crate::run::{RunPlan, StartState};
use serde::Serialize;

/// Parts into which the averaging window of a member is cut.
pub(super) const BATCHES: usize = 16;

/// Answers of one realisation over its averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Member {
    /// Number of the realisation under its seed.
    pub index: usize,
    /// Mean power of all loads together, W.
    pub mean_power_w: f64,
    /// Mean power of each load, W.
    pub loads_w: Vec<f64>,
    /// Mean power in each batch of the window, W.
    pub batches_w: Vec<f64>,
    /// Contacts that began.
    pub contacts: u64,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// Mean speed at which contacts began, m/s; 0 without contact.
    pub mean_strike_m_s: f64,
    /// Largest of these speeds, m/s.
    pub max_strike_m_s: f64,
    /// Mean time that a contact lasts, s; 0 without contact.
    pub mean_dwell_s: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Energy residual of the whole march over its largest energy.
    pub energy_residual_relative: f64,
}

impl Member {
    /// Marches a realisation.
    pub(super) fn march(kernel: &Kernel, start: &StartState, plan: &RunPlan, index: usize) -> Result<Self, MarchError> {
        let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(&start.physical(), 0.0), 0.0, plan.tolerance)?;
        let (begin_s, window_s) = (plan.duration_s - plan.average_over_s, plan.average_over_s);
        marcher.advance_to(begin_s)?;
        marcher.reset_statistics();
        let opened = marcher.energies().loads_j;
        let total = |loads_j: &[f64]| loads_j.iter().sum::<f64>();
        let (mut batches_w, mut before_j) = (Vec::with_capacity(BATCHES), total(&opened));
        for batch in 1..=BATCHES {
            let share = batch as f64 / BATCHES as f64;
            marcher.advance_to(if batch == BATCHES { plan.duration_s } else { begin_s + window_s * share })?;
            let now_j = total(&marcher.energies().loads_j);
            batches_w.push((now_j - before_j) * BATCHES as f64 / window_s);
            before_j = now_j;
        }
        let energies = marcher.energies();
        let loads_w: Vec<f64> = energies.loads_j.iter().zip(&opened).map(|(end, start)| (end - start) / window_s).collect();
        let statistics = marcher.statistics();
        let each = |sum: f64| if statistics.contacts > 0 { sum / statistics.contacts as f64 } else { 0.0 };
        Ok(Self {
            index,
            mean_power_w: loads_w.iter().sum(),
            loads_w,
            batches_w,
            contacts: statistics.contacts,
            contact_rate_hz: statistics.contacts as f64 / window_s,
            mean_strike_m_s: each(statistics.strike_sum_m_s),
            max_strike_m_s: statistics.max_strike_m_s,
            mean_dwell_s: each(statistics.time_s),
            max_penetration_m: statistics.max_penetration_m,
            energy_residual_relative: energies.residual_relative(),
        })
    }
}
