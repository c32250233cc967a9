//! Plan of a run.

use super::Limits;
use jounce_model::plant::Plant;
use jounce_spec::{Run, Spec};

/// Largest number of drive cycles of the window of peaks.
const MAX_PEAK_CYCLES: f64 = 1000.0;

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

    /// Returns the length of the window of peaks, s: the averaging window, with periodic drives at
    /// most its last 1000 cycles, whose record fits in memory.
    pub fn peak_window_s(&self, plant: &Plant) -> f64 {
        let longest_s = plant.period_s().map(|period_s| MAX_PEAK_CYCLES * period_s);
        longest_s.map_or(self.average_over_s, |longest_s| {
            self.average_over_s.min(longest_s)
        })
    }

    /// Returns the plan with a record of the window of peaks; without a common period of the drives
    /// only if a patch has limits.
    #[must_use]
    pub fn watching(self, spec: &Spec, plant: &Plant) -> Self {
        let records = plant.period_s().is_some() || !Limits::of(spec, plant).is_empty();
        let window_s = if records {
            self.peak_window_s(plant)
        } else {
            0.0
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
