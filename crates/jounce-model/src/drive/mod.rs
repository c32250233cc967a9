//! Time signals of drives: from the spec to samples with linear interpolation.
//!
//! A sampled signal is a first-order hold: linear between its samples, as a recording means. A
//! smooth signal `u` is sampled as `u - h^2 u'' / 12 + h^4 u'''' / 240`, so that the linear
//! interpolant has the spectrum of `u`. Interpolation multiplies the spectrum by `sinc^2(f h)`, the
//! samples by its inverse. The images about multiples of the sampling rate `1 / h` remain, smaller
//! than `u` by `(f h / (1 - f h))^2`.

mod chirp;
mod displaced;
mod noise;
mod pulse;
mod travel;
mod wave;

pub use chirp::{Chirp, chirp};
pub use displaced::displaced;
pub use noise::{NoiseBand, noise};
pub use pulse::half_sine;
pub use travel::Travel;
pub use wave::{Wave, WavePiece};

use jounce_spec::DriveSignal;
use std::f64::consts::TAU;

/// Returns the signal of a drive for the first `duration_s` of a run; `None` for a sinusoid. Noise
/// is zero once `is_stopped` returns true.
pub fn wave(signal: &DriveSignal, duration_s: f64, is_stopped: &dyn Fn() -> bool) -> Option<Wave> {
    match *signal {
        DriveSignal::Sine { .. } => None,
        DriveSignal::Chirp {
            amplitude,
            from_hz,
            to_hz,
            sweep,
            phase_rad,
            start_s,
            duration_s,
        } => Some(chirp(&Chirp {
            amplitude,
            from_hz,
            to_hz,
            sweep,
            phase_rad,
            start_s,
            duration_s,
        })),
        DriveSignal::HalfSine {
            amplitude,
            start_s,
            duration_s,
        } => Some(half_sine(amplitude, start_s, duration_s)),
        DriveSignal::VelocityStep {
            velocity_m_s,
            start_s,
        } => Some(Wave::Impulse {
            time_s: start_s,
            size_s: velocity_m_s,
        }),
        DriveSignal::Noise {
            density,
            low_hz,
            high_hz,
            sample_rate_hz,
            seed,
        } => {
            let sample_rate_hz = sample_rate_hz.unwrap_or(DriveSignal::SAMPLES_PER_CYCLE * high_hz);
            let band = NoiseBand {
                density,
                low_hz,
                high_hz,
                sample_rate_hz,
            };
            Some(noise(&band, duration_s, seed, is_stopped))
        }
        DriveSignal::Recording {
            scale,
            start_s,
            ref record,
            ..
        } => record.as_ref().map(|record| Wave::Sampled {
            start_s,
            step_s: record.step_s,
            sizes: record.values.iter().map(|value| scale * value).collect(),
        }),
    }
}

/// `sin(x) / x` with `x = pi f h`, squared: the factor of linear interpolation on a sinusoid.
fn hold(frequency_hz: f64, step_s: f64) -> f64 {
    let x = 0.5 * TAU * frequency_hz * step_s;
    if x == 0.0 { 1.0 } else { (x.sin() / x).powi(2) }
}
