//! Statistics of an integration: contacts, and the contact integrals that the energy meters need.

use crate::kernel::Kernel;
use crate::ports::per_port::PerPort;
use jounce_linalg::c64;

/// Work done by the integrator, for snapshots that detect an increase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct WorkCount {
    /// Flight steps taken.
    pub flight_steps: u64,
    /// Flight steps attempted and shortened, because they could not be proved free of contact.
    pub flight_rejections: u64,
    /// Contact steps taken.
    pub contact_steps: u64,
    /// Contact steps attempted and shortened, because their error was too large.
    pub contact_rejections: u64,
    /// Fixed-point iterations of all contact steps.
    pub iterations: u64,
}

/// Contact statistics since the last reset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ContactStatistics {
    /// Contacts that began.
    pub contacts: u64,
    /// Time in contact, s.
    pub time_s: f64,
    /// Largest penetration, m; 0 without contact (the distance of approach is not tracked). For a
    /// law on both sides: largest distance.
    pub max_penetration_m: f64,
    /// Largest magnitude of the contact force, N.
    pub max_force_n: f64,
    /// Time integral of the contact force, N s.
    pub impulse_n_s: f64,
    /// Sum of the impact speeds of all contacts, m/s.
    pub strike_sum_m_s: f64,
    /// Largest impact speed, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Longest duration of one contact, s; for a contact in progress at the last reset, the time
    /// since the reset.
    pub max_contact_duration_s: f64,
    /// Time of sticking to a rigid stop, s.
    pub sticking_s: f64,
}

impl ContactStatistics {
    /// Returns the mean impact speed, m/s; 0 without a contact.
    pub fn mean_impact_velocity_m_s(&self) -> f64 {
        self.strike_sum_m_s / self.contacts.max(1) as f64
    }

    /// Returns the time in contact divided by the number of contacts that began, s; 0 without a
    /// contact.
    pub fn mean_contact_duration_s(&self) -> f64 {
        if self.contacts > 0 {
            self.time_s / self.contacts as f64
        } else {
            0.0
        }
    }

    /// Combines the statistics of two ports: maxima of the maxima, sums of the others.
    pub(crate) fn and(self, other: &Self) -> Self {
        Self {
            contacts: self.contacts + other.contacts,
            time_s: self.time_s + other.time_s,
            max_penetration_m: self.max_penetration_m.max(other.max_penetration_m),
            max_force_n: self.max_force_n.max(other.max_force_n),
            impulse_n_s: self.impulse_n_s + other.impulse_n_s,
            strike_sum_m_s: self.strike_sum_m_s + other.strike_sum_m_s,
            max_impact_velocity_m_s: self
                .max_impact_velocity_m_s
                .max(other.max_impact_velocity_m_s),
            max_contact_duration_s: self
                .max_contact_duration_s
                .max(other.max_contact_duration_s),
            sticking_s: self.sticking_s + other.sticking_s,
        }
    }
}

/// Contact integrals since the start of the integration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactIntegrals {
    /// `sum over ports of integral f (P b) . y dt` per load, J.
    pub loads_j: Vec<f64>,
    /// Integral of the same form for damping, J.
    pub damping_j: f64,
    /// `integral f e^{i w t} dt` per port and tone, N s.
    pub tones_n_s: PerPort<Vec<c64>>,
    /// Energy lost in the contact law, J.
    pub loss_j: f64,
}

impl ContactIntegrals {
    /// Returns the integrals at the start of an integration.
    pub fn none(kernel: &Kernel) -> Self {
        let (plant, none) = (&kernel.plant, c64::new(0.0, 0.0));
        Self {
            loads_j: vec![0.0; kernel.meters().loads.len()],
            tones_n_s: PerPort::new(plant.ports.len(), |_| vec![none; plant.tones.len()]),
            ..Self::default()
        }
    }
}
