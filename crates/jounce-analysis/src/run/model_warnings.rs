//! Warnings that are known before the integration.

use super::{RunPlan, Warning, ineffective, model_limits, polarity};
use jounce_model::plant::Plant;
use jounce_spec::{DriveSignal, Spec};

/// Fraction of the averaging window that may lie after the end of a recording.
const MAX_UNRECORDED_SHARE: f64 = 0.01;

/// Share of the averaging window outside whole periods below which its effect on the means is small.
const MAX_PART_OF_PERIOD: f64 = 0.01;

impl Warning {
    /// Returns the warnings of a run that are known before its integration.
    pub fn of_model(spec: &Spec, plant: &Plant, plan: &RunPlan) -> Vec<Self> {
        let mut warnings = Self::of_recordings(spec, plan);
        warnings.extend(model_limits::of_model(spec, plant));
        warnings.extend(polarity::cancelling(plant));
        warnings.extend(Self::of_window(plant, plan));
        warnings.extend(ineffective::drives(spec, plant));
        warnings
    }

    /// Returns a warning for each recording of a spec that ends before the averaging window of a
    /// plan.
    pub fn of_recordings(spec: &Spec, plan: &RunPlan) -> Vec<Self> {
        let (from_s, to_s) = (plan.duration_s - plan.average_over_s, plan.duration_s);
        let ends = spec
            .drive
            .iter()
            .filter_map(|(name, drive)| match &drive.signal {
                DriveSignal::Recording {
                    start_s,
                    record: Some(record),
                    ..
                } => Some((name.clone(), start_s + record.duration_s())),
                _ => None,
            });
        let early =
            ends.filter(|(_, ends_s)| to_s - ends_s > MAX_UNRECORDED_SHARE * plan.average_over_s);
        early
            .map(|(drive, ends_s)| Self::RecordingEnds {
                drive,
                ends_s: printed(ends_s),
                from_s: printed(from_s),
                to_s,
            })
            .collect()
    }

    /// Returns a warning where a part of the averaging window is outside whole periods of the drives.
    fn of_window(plant: &Plant, plan: &RunPlan) -> Option<Self> {
        let period_s = plant.period_s()?;
        let periods = plan.average_over_s / period_s;
        let part = (periods - periods.round()).abs() / periods;
        (part > MAX_PART_OF_PERIOD).then_some(Self::PartOfPeriod {
            average_over_s: plan.average_over_s,
            period_s,
        })
    }
}

/// Rounds a sum of decimal times to nine digits after the point.
fn printed(time_s: f64) -> f64 {
    format!("{time_s:.9e}").parse().unwrap_or(time_s)
}
