//! Harvester driven by a recorded base motion.

use std::sync::Arc;

use jounce_spec as spec;
use jounce_spec::{Drive, DriveKind, DriveSignal, Spec};

use super::RigError;
use jounce_data::recording::Recording;

/// Removes all drives and moves the base by a channel of a uniform recording, for its full length,
/// which is also the averaging time. Returns the mean of the channel, m/s^2. Unless `keep_mean` is
/// true the mean is subtracted, because the mean of an accelerometer is gravity and offset.
///
/// # Errors
/// [`spec::RecordingError`], and a base in addition to the ground.
pub fn on_recorded_base(
    spec: &mut Spec,
    recording: &Recording,
    channel: &str,
    keep_mean: bool,
) -> Result<f64, RigError> {
    let kind = DriveKind::BaseAcceleration;
    let record = spec::Recording::of(recording, channel, kind, (1.0, keep_mean))?;
    if let Some(base) = spec.bases().first() {
        return Err(RigError::Bases {
            base: (*base).to_owned(),
            what: "a recorded base",
        });
    }
    (spec.run.duration_s, spec.run.average_over_s) = (record.duration_s(), record.duration_s());
    spec.run.start = spec::Start::Rest;
    let mean = record.mean;
    let mut signal = DriveSignal::recording(&recording.name);
    if let DriveSignal::Recording { record: read, .. } = &mut signal {
        *read = Some(Arc::new(record));
    }
    spec.drive.clear();
    spec.drive.insert(
        "base".to_owned(),
        Drive {
            at: String::new(),
            kind,
            signal,
        },
    );
    Ok(mean)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::paper_spec;
    use super::*;
    use jounce_data::recording::{Channel, Grid, Over, Quantity};

    fn of_base(values: Vec<f64>, keep_mean: bool) -> Result<f64, RigError> {
        let grid = Grid::even(0.0, 1e-3, values.len()).unwrap();
        let channels = vec![Channel::new("ax", Quantity::Acceleration, "m/s^2", values)];
        let recording = Recording {
            name: "base".to_owned(),
            over: Over::Time,
            grid,
            channels,
            issues: Vec::new(),
        };
        on_recorded_base(&mut paper_spec(&[]), &recording, "ax", keep_mean)
    }

    #[test]
    fn a_base_at_rest_or_of_no_numbers_is_refused() {
        for constant in [
            of_base(vec![0.0; 100], false),
            of_base(vec![0.0; 100], true),
            of_base(vec![9.81; 100], false),
        ] {
            assert!(
                matches!(
                    constant,
                    Err(RigError::Recording(spec::RecordingError::Still { .. }))
                ),
                "{constant:?}"
            );
        }
        assert!(
            of_base(vec![9.81; 100], true).is_ok(),
            "a steady push that is kept moves the beam"
        );
        assert!(
            of_base([vec![f64::NAN], vec![1.0; 99]].concat(), false)
                .unwrap_err()
                .to_string()
                .contains("finite")
        );
    }
}
