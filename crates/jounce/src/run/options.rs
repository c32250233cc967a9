//! Options of a run.

use crate::error::Error;
use crate::options::{defaults, frequency_hz, time_s};
use jounce_analysis::run::StartState;
use jounce_spec::Spec;
use serde::{Deserialize, Serialize};

/// Largest number of samples of a record.
const MAX_SAMPLES: f64 = 1e8;
/// Smallest number of samples of a recorded averaging window.
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
    #[serde(skip)]
    pub start: Option<StartState>,
    /// Length of the stored end of the run, for example "1 s"; with 0 s the averaging window with
    /// --out, else nothing.
    #[arg(long = "record", value_name = "TIME", value_parser = time_s, default_value = "0 s")]
    pub record_s: f64,
    /// Sampling rate of the stored end of the run.
    #[arg(long = "sample-rate", value_name = "FREQUENCY", value_parser = frequency_hz, default_value = "4096 Hz")]
    pub sample_rate_hz: f64,
}

impl Default for RunOptions {
    fn default() -> Self {
        defaults()
    }
}

impl RunOptions {
    /// Records the averaging window of a spec, unless a record is requested; a short window has a
    /// higher sampling rate.
    #[must_use]
    pub fn with_record(self, spec: &Spec) -> Self {
        if self.record_s > 0.0 {
            return self;
        }
        let record_s = spec.run.average_over_s;
        let sample_rate_hz = self.sample_rate_hz.max(MIN_SAMPLES / record_s);
        Self {
            record_s,
            sample_rate_hz,
            ..self
        }
    }

    /// Checks the record against the duration of the run, s.
    pub(super) fn check(&self, duration_s: f64) -> Result<(), Error> {
        let (record_s, rate_hz) = (self.record_s, self.sample_rate_hz);
        if !(0.0..=duration_s).contains(&record_s) {
            let expected = format!("it must be from 0 s to run.duration = {duration_s} s");
            return Err(Error::option("record", format!("{record_s} s"), expected));
        }
        if !(rate_hz > 0.0 && rate_hz.is_finite()) {
            return Err(Error::option(
                "sample_rate",
                format!("{rate_hz} Hz"),
                "it must be greater than 0 Hz",
            ));
        }
        if record_s * rate_hz > MAX_SAMPLES {
            let expected = format!(
                "with a `record` of {record_s} s that is {:e} samples; at most {MAX_SAMPLES:e} are stored",
                record_s * rate_hz
            );
            return Err(Error::option(
                "sample_rate",
                format!("{rate_hz} Hz"),
                expected,
            ));
        }
        Ok(())
    }
}
