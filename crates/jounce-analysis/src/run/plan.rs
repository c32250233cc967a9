//! Plan of a run.

use super::Limits;
use jounce_model::plant::Plant;
use jounce_spec::{Run, Spec};

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
            .any(|bridge| bridge.storage.capacitance_f().is_some());
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
