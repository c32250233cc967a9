//! Record of the drive cycles of a period.

use jounce_dynamics::{ContactStatistics, Trajectory};
use jounce_model::plant::Plant;

/// Sums and trajectories of the drive cycles of a period so far.
pub struct PeriodRecord {
    /// `u` at the start of each cycle, then at the end of the period.
    pub strobe_states: Vec<Vec<f64>>,
    /// Trajectory of each cycle.
    pub trajectories: Vec<Trajectory>,
    /// Number of contacts.
    pub contacts: u64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Largest magnitude of a contact force, N.
    pub max_contact_force_n: f64,
    /// Largest impact speed, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean power of each load and then of each bridge, W.
    pub loads_w: Vec<f64>,
}

impl PeriodRecord {
    /// Starts at `u`.
    pub fn new(plant: &Plant, unknown: Vec<f64>) -> Self {
        Self {
            strobe_states: vec![unknown],
            trajectories: Vec::new(),
            contacts: 0,
            max_penetration_m: 0.0,
            max_contact_force_n: 0.0,
            max_impact_velocity_m_s: 0.0,
            loads_w: vec![0.0; plant.system.loads.len() + plant.system.bridges.len()],
        }
    }

    /// Adds the contacts of a cycle.
    pub fn add_contacts(&mut self, statistics: &ContactStatistics) {
        self.contacts += statistics.contacts;
        self.max_penetration_m = self.max_penetration_m.max(statistics.max_penetration_m);
        self.max_contact_force_n = self.max_contact_force_n.max(statistics.max_force_n);
        self.max_impact_velocity_m_s = self
            .max_impact_velocity_m_s
            .max(statistics.max_impact_velocity_m_s);
    }

    /// Adds the energy delivered in a cycle to the mean powers over the period.
    pub fn add_delivered(&mut self, delivered_j: impl Iterator<Item = f64>, period_s: f64) {
        self.loads_w
            .iter_mut()
            .zip(delivered_j)
            .for_each(|(sum, j)| *sum += j / period_s);
    }

    /// Returns `u` at the end of the last cycle.
    pub fn end(&self) -> &[f64] {
        &self.strobe_states[self.strobe_states.len() - 1]
    }
}
