//! Signal of a drive.

use crate::recording::Recording;
use std::sync::Arc;

/// Signal of a drive; the kind of the drive determines the unit of amplitudes: N, m/s^2 or m.
#[derive(Debug, Clone, PartialEq)]
pub enum DriveSignal {
    /// `"sine"`: `amplitude * sin(2 pi frequency t + phase)`.
    Sine {
        /// `amplitude`, zero to peak.
        amplitude: f64,
        /// `frequency`
        frequency_hz: f64,
        /// `phase`, rad; default 0.
        phase_rad: f64,
    },
    /// `"chirp"`: a sinusoid whose frequency varies from `from` to `to` within `duration`.
    Chirp {
        /// `amplitude`, zero to peak.
        amplitude: f64,
        /// `from`
        from_hz: f64,
        /// `to`
        to_hz: f64,
        /// `sweep`; default `linear`.
        sweep: FrequencySweep,
        /// `phase` at its start, rad; default 0.
        phase_rad: f64,
        /// `start`, s; default 0.
        start_s: f64,
        /// `duration`, s.
        duration_s: f64,
    },
    /// `"half-sine"`: the pulse `amplitude * sin(pi (t - start) / duration)`.
    HalfSine {
        /// `amplitude`, peak.
        amplitude: f64,
        /// `start`, s; default 0.
        start_s: f64,
        /// `duration`, s.
        duration_s: f64,
    },
    /// `"velocity-step"`: a jump of the base velocity.
    VelocityStep {
        /// `velocity`, m/s.
        velocity_m_s: f64,
        /// `start`, s; default 0.
        start_s: f64,
    },
    /// `"noise"`: Gaussian noise of a flat one-sided power spectral density from `low` to `high`.
    Noise {
        /// `psd`, one-sided: N^2/Hz or (m/s^2)^2/Hz.
        density: f64,
        /// `low`; default 0.
        low_hz: f64,
        /// `high`
        high_hz: f64,
        /// `sample_rate`; default [`DriveSignal::SAMPLES_PER_CYCLE`] times `high`.
        sample_rate_hz: Option<f64>,
        /// `seed`; default 1.
        seed: u64,
    },
    /// `"recording"`: samples of a file with linear interpolation; 0 before the first and after the
    /// last.
    Recording {
        /// `file`: path of the recording, relative to the spec.
        file: String,
        /// `channel`: its name, or its number from 1; if omitted, the only channel that fits.
        channel: Option<String>,
        /// `unit` of the channel, if the file contains no unit of this quantity.
        unit: Option<String>,
        /// `scale`: factor on the values; default 1.
        scale: f64,
        /// `mean`: true if the mean of the channel is retained; see
        /// [`DriveKind::keeps_mean`](crate::DriveKind::keeps_mean).
        keep_mean: Option<bool>,
        /// `start`: time of the first sample in the run, s; default 0.
        start_s: f64,
        /// `sample_rate` of a file without times; checked against the times of a file that has
        /// them.
        sample_rate_hz: Option<f64>,
        /// Contents of the file; `None` until it is read.
        record: Option<Arc<Recording>>,
    },
}

/// Variation of the frequency of a chirp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FrequencySweep {
    /// The same number of hertz in each second.
    #[default]
    Linear,
    /// The same factor in each second.
    Logarithmic,
}

impl DriveSignal {
    /// Samples of noise per cycle of its highest frequency.
    pub const SAMPLES_PER_CYCLE: f64 = 10.0;
    /// Samples of a chirp per shortest cycle.
    pub const CHIRP_SAMPLES_PER_CYCLE: f64 = 256.0;

    /// Returns a recording of a file with all other keys at their defaults; the file is not read
    /// yet.
    pub fn recording(file: &str) -> Self {
        Self::Recording {
            file: file.to_owned(),
            channel: None,
            unit: None,
            scale: 1.0,
            keep_mean: None,
            start_s: 0.0,
            sample_rate_hz: None,
            record: None,
        }
    }
}
