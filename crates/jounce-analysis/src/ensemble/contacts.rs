//! Contact statistics of each stop over the members of an ensemble, with 95 % intervals.

use super::estimate::{Estimate, IntervalOver};
use super::member::Member;
use jounce_dynamics::ContactStatistics;
use serde::Serialize;

/// Contacts of one stop in a time interval.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ContactCount {
    /// Contacts that began.
    pub contacts: u64,
    /// Sum of the impact velocities of these contacts, m/s.
    pub strike_sum_m_s: f64,
    /// Time in contact, s.
    pub time_s: f64,
}

impl ContactCount {
    /// Returns the increase since an earlier count.
    pub(super) fn since(statistics: &ContactStatistics, earlier: &Self) -> Self {
        Self {
            contacts: statistics.contacts - earlier.contacts,
            strike_sum_m_s: statistics.strike_sum_m_s - earlier.strike_sum_m_s,
            time_s: statistics.time_s - earlier.time_s,
        }
    }

    /// Returns the sum of two counts.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            contacts: self.contacts + other.contacts,
            strike_sum_m_s: self.strike_sum_m_s + other.strike_sum_m_s,
            time_s: self.time_s + other.time_s,
        }
    }
}

/// One stop in one member, over its averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MemberStop {
    /// Count in each batch of the window.
    pub batches: Vec<ContactCount>,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Longest duration of a contact, s.
    pub max_contact_duration_s: f64,
    /// Largest contact force, N; 0 for impacts on a rigid stop.
    pub max_contact_force_n: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
}

impl MemberStop {
    fn total(&self) -> ContactCount {
        self.batches
            .iter()
            .fold(ContactCount::default(), |sum, batch| sum.and(batch))
    }
}

/// One stop over the ensemble.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StopEstimates {
    /// Name of the stop.
    pub name: String,
    /// Contacts per second, Hz.
    pub contact_rate_hz: Estimate,
    /// Mean impact velocity, m/s.
    pub mean_impact_velocity_m_s: Estimate,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean duration of a contact, s.
    pub mean_contact_duration_s: Estimate,
    /// Longest duration of a contact, s.
    pub max_contact_duration_s: f64,
    /// Fraction of the time in contact, 0 to 1.
    pub contact_duty: Estimate,
    /// Largest contact force, N; 0 for impacts on a rigid stop.
    pub max_contact_force_n: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
}

impl StopEstimates {
    /// Estimates of stop number `index`; a batch lasts `batch_s`.
    pub(super) fn of(name: &str, members: &[Member], index: usize, batch_s: f64) -> Self {
        let interval = IntervalOver::of(members.len());
        let stops = || members.iter().map(move |member| &member.stops[index]);
        let (counts, length_s): (Vec<ContactCount>, f64) = match interval {
            IntervalOver::Members => (
                stops().map(MemberStop::total).collect(),
                batch_s * super::member::BATCHES as f64,
            ),
            IntervalOver::Batches => (
                stops()
                    .flat_map(|stop| stop.batches.iter().copied())
                    .collect(),
                batch_s,
            ),
        };
        let over = |value: fn(&ContactCount) -> f64, of: fn(&ContactCount, f64) -> f64| {
            let pairs: Vec<[f64; 2]> = counts
                .iter()
                .map(|count| [value(count), of(count, length_s)])
                .collect();
            Estimate::of_ratio(&pairs, interval)
        };
        let largest = |value: fn(&MemberStop) -> f64| stops().map(value).fold(0.0, f64::max);
        Self {
            name: name.to_owned(),
            contact_rate_hz: over(|count| count.contacts as f64, |_, length_s| length_s),
            mean_impact_velocity_m_s: over(
                |count| count.strike_sum_m_s,
                |count, _| count.contacts as f64,
            ),
            max_impact_velocity_m_s: largest(|stop| stop.max_impact_velocity_m_s),
            mean_contact_duration_s: over(|count| count.time_s, |count, _| count.contacts as f64),
            max_contact_duration_s: largest(|stop| stop.max_contact_duration_s),
            contact_duty: over(|count| count.time_s, |_, length_s| length_s),
            max_contact_force_n: largest(|stop| stop.max_contact_force_n),
            max_penetration_m: largest(|stop| stop.max_penetration_m),
        }
    }
}
