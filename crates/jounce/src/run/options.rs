//! Options of a run.

use crate::error::Error;
use crate::options::{defaults, frequency_hz, time_s};
use jounce_analysis::run::StartState;
use jounce_spec::{Drive, Spec};
use serde::{Deserialize, Serialize};

/// Largest number of samples of a record.
const MAX_SAMPLES: f64 = 1e8;
/// Sampling rate by default, Hz.
const SAMPLE_RATE_HZ: f64 = 4096.0;
/// Smallest number of samples of a recorded averaging window by default.
const MIN_SAMPLES: f64 = 1024.0;

/// Options of [`crate::Harvester::run`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RunOptions {
    /// Required relative error of the response; overrides run.tolerance.
    #[arg(long)]
    pub tolerance: Option<f64>,
    /// State at the end of another run; overrides run.start.
    #[arg(skip)]
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none")]
    pub start: Option<StartState>,
    /// Length of the stored end of the run, for example "1 s"; with 0 s the averaging window with
    /// --out, else nothing.
    #[arg(long = "record", value_name = "TIME", value_parser = time_s, default_value = "0 s")]
    pub record_s: f64,
    /// Sampling rate of the stored end of the run; by default 4096 Hz, and higher for the averaging
    /// window where it is short.
    #[arg(long = "sample-rate", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub sample_rate_hz: Option<f64>,
}

impl Default for RunOptions {
    fn default() -> Self {
        defaults()
    }
}

impl RunOptions {
    /// Records the averaging window of a spec, unless a record is requested.
    #[must_use]
    pub fn with_record(self, spec: &Spec) -> Self {
        if self.record_s > 0.0 {
            return self;
        }
        let record_s = spec.run.average_over_s;
        let by_default = SAMPLE_RATE_HZ.max(MIN_SAMPLES / record_s);
        Self {
            record_s,
            sample_rate_hz: self.sample_rate_hz.or(Some(by_default)),
            ..self
        }
    }

    /// Returns the sampling rate of the record, Hz.
    pub(super) fn sampled_at_hz(&self) -> f64 {
        self.sample_rate_hz.unwrap_or(SAMPLE_RATE_HZ)
    }

    /// Returns the message that the record is sampled too slowly for a harmonic drive.
    pub fn warnings(&self, spec: &Spec) -> Vec<String> {
        let rate_hz = self.sampled_at_hz();
        let frequencies_hz = spec.drive.values().filter_map(Drive::frequency_hz);
        let fastest_hz = frequencies_hz.fold(0.0, f64::max);
        if self.record_s == 0.0 || rate_hz >= 2.0 * fastest_hz {
            return Vec::new();
        }
        vec![format!(
            "`sample_rate` is {rate_hz} Hz, below twice the drive frequency of {fastest_hz} Hz: the stored signals and their spectra are aliased"
        )]
    }

    /// Checks the record against the duration of the run, s.
    pub(super) fn check(&self, duration_s: f64) -> Result<(), Error> {
        let (record_s, rate_hz) = (self.record_s, self.sampled_at_hz());
        if !(0.0..=duration_s).contains(&record_s) {
            let expected = format!("it must be from 0 s to run.duration = {duration_s} s");
            return Err(Error::option("record", format!("{record_s} s"), expected));
        }
        let fault = |expected: String| {
            Err(Error::option(
                "sample_rate",
                format!("{rate_hz} Hz"),
                expected,
            ))
        };
        if self.sample_rate_hz.is_some() && record_s == 0.0 {
            return fault("nothing is stored at this rate; give `record` too".to_owned());
        }
        if !(rate_hz > 0.0 && rate_hz.is_finite()) {
            return fault("it must be greater than 0 Hz".to_owned());
        }
        let samples = record_s * rate_hz;
        if samples > MAX_SAMPLES {
            return fault(format!(
                "with a `record` of {record_s} s that is {samples:e} samples; at most {MAX_SAMPLES:e} are stored"
            ));
        }
        Ok(())
    }
}
