//! The course of a drive in time.

use crate::spec::recording::Recording;
use std::sync::Arc;

/// The course of a drive in time; amplitudes in N, m/s^2 or m, by the kind of the drive.
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
    /// `"chirp"`: a sinusoid whose frequency goes from `from` to `to` in the time `duration`.
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
    /// `"velocity-step"`: the base jumps to another velocity.
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
    /// `"recording"`: samples of a file, joined by straight lines; 0 before the first and after the last.
    Recording {
        /// `file`: path of the recording, relative to the spec.
        file: String,
        /// `channel`: its name, or its number from 1; the only fitting one where it is not given.
        channel: Option<String>,
        /// `unit`: that of the channel, where the file gives none of this quantity.
        unit: Option<String>,
        /// `scale`: factor of the values; default 1.
        scale: f64,
        /// `mean`: true where the mean of the channel is kept; see [`DriveKind::keeps_mean`](crate::spec::DriveKind::keeps_mean).
        keep_mean: Option<bool>,
        /// `start`: time of the first sample in the run, s; default 0.
        start_s: f64,
        /// `sample_rate`: that of a file which tells none; what one that does is checked against.
        sample_rate_hz: Option<f64>,
        /// What the file holds; `None` until it is read.
        record: Option<Arc<Recording>>,
    },
}

/// How the frequency of a chirp goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FrequencySweep {
    /// By the same number of hertz in each second.
    #[default]
    Linear,
    /// By the same factor in each second.
    Logarithmic,
}

impl DriveSignal {
    /// Samples of noise in a cycle of its highest frequency.
    pub const SAMPLES_PER_CYCLE: f64 = 10.0;
    /// Samples of a chirp in its shortest cycle.
    pub const CHIRP_SAMPLES_PER_CYCLE: f64 = 256.0;

    /// The recording of a file, nothing else said of it and not read yet.
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
