//! Plan of a run.

use super::Limits;
use jounce_model::plant::Plant;
use jounce_spec::{Run, Spec};

/// Largest number of drive cycles of a record for peaks, which fits in memory.
const MAX_PEAK_CYCLES: f64 = 10_000.0;

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

    /// Returns the plan with a record of the averaging window, at most 10000 drive cycles; without a
    /// common period of the drives only if a patch has limits.
    #[must_use]
    pub fn watching(self, spec: &Spec, plant: &Plant) -> Self {
        let window_s = match plant.period_s() {
            Some(period_s) => self.average_over_s.min(MAX_PEAK_CYCLES * period_s),
            None if Limits::of(spec, plant).is_empty() => 0.0,
            None => self.average_over_s,
        };
        Self {
            record_s: self.record_s.max(window_s),
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
