//! A harvester whose base moves as it was recorded.

use std::sync::Arc;

use jounce::spec::{self, Drive, DriveKind, DriveSignal, Spec};

use super::RigError;
use crate::recording::{Grid, Over, Quantity, Recording};

/// What a constant channel keeps of its mean by roundoff, over the mean.
const ROUNDOFF: f64 = 1e-12;

/// Takes every drive away and moves the base by a channel of a recording at even times, for as long as the recording lasts; the mean of
/// that time is averaged over. Gives the mean of the channel, m/s^2: where `keep_mean` is false it is taken away, because that of an
/// accelerometer is gravity and offset.
///
/// # Errors
/// A channel that is not there, no acceleration or at rest, a recording over frequency or of fewer than two samples.
pub fn on_recorded_base(spec: &mut Spec, recording: &Recording, channel: &str, keep_mean: bool) -> Result<f64, RigError> {
    let values = &recording.channel(channel)?.values;
    let found = recording.channel(channel)?;
    if found.quantity != Quantity::Acceleration && found.quantity != Quantity::Unknown {
        return Err(RigError::NotAcceleration { channel: found.name.clone(), unit: found.unit.clone() });
    }
    let (Grid::Even { step, count, .. }, Over::Time) = (&recording.grid, recording.over) else {
        return Err(RigError::NotEven { recording: recording.name.clone() });
    };
    if let Some(base) = spec.bases().first() {
        return Err(RigError::Bases { base: (*base).to_owned(), what: "a recorded base" });
    }
    if *count < 2 {
        return Err(RigError::Setting { name: "the number of samples of the base", value: *count as f64, allowed: "at least 2" });
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let offset = if keep_mean { 0.0 } else { mean };
    if let Some(value) = values.iter().find(|x| !x.is_finite()) {
        return Err(RigError::Setting { name: "a sample of the base", value: *value, allowed: "a number: fill the gaps of the recording" });
    }
    let largest = values.iter().fold(0.0, |largest: f64, x| largest.max((x - offset).abs()));
    if largest <= ROUNDOFF * mean.abs() {
        return Err(RigError::Still { channel: found.name.clone(), mean_m_s2: mean });
    }
    let record = spec::Recording { step_s: *step, values: values.iter().map(|x| x - offset).collect() };
    let signal = DriveSignal::Recording {
        file: recording.name.clone(),
        scale: 1.0,
        start_s: 0.0,
        sample_rate_hz: None,
        record: Some(Arc::new(record)),
    };
    spec.drive.clear();
    spec.drive.insert("base".to_owned(), Drive { at: String::new(), kind: DriveKind::BaseAcceleration, signal });
    spec.run.duration_s = step * (count - 1) as f64;
    spec.run.average_over_s = spec.run.duration_s;
    spec.run.start = spec::Start::Rest;
    Ok(mean)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::Channel;
    use jounce::reproduce::paper_spec;

    fn of_base(values: Vec<f64>, keep_mean: bool) -> Result<f64, RigError> {
        let grid = Grid::even(0.0, 1e-3, values.len()).unwrap();
        let channels = vec![Channel::new("ax", Quantity::Acceleration, "m/s^2", values)];
        let recording = Recording { name: "base".to_owned(), over: Over::Time, grid, channels, findings: Vec::new() };
        on_recorded_base(&mut paper_spec(&[]).unwrap(), &recording, "ax", keep_mean)
    }

    #[test]
    fn a_base_at_rest_or_of_no_numbers_is_refused() {
        for still in [of_base(vec![0.0; 100], false), of_base(vec![0.0; 100], true), of_base(vec![9.81; 100], false)] {
            assert!(matches!(still, Err(RigError::Still { .. })), "{still:?}");
        }
        assert!(of_base(vec![9.81; 100], true).is_ok(), "a steady push that is kept moves the beam");
        assert!(of_base([vec![f64::NAN], vec![1.0; 99]].concat(), false).unwrap_err().to_string().contains("sample of the base"));
    }
}
