//! Chirps: sinusoids whose frequency sweeps.
//!
//! ```text
//! u(t) = A sin(p(t)),   p' = 2 pi f(t)
//! linear       f = f0 + (f1 - f0) t / T,        p = p0 + 2 pi (f0 t + (f1 - f0) t^2 / (2 T))
//! logarithmic  f = f0 (f1 / f0)^(t / T),        p = p0 + 2 pi f0 T ((f1 / f0)^(t / T) - 1) / ln(f1 / f0)
//! ```

use super::Wave;
use jounce_spec::{DriveSignal, FrequencySweep};
use std::f64::consts::TAU;

/// Sinusoid with a frequency sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chirp {
    /// `A`, zero to peak.
    pub amplitude: f64,
    /// `f0`, Hz.
    pub from_hz: f64,
    /// `f1`, Hz.
    pub to_hz: f64,
    /// Law of the frequency.
    pub sweep: FrequencySweep,
    /// `p0`, rad.
    pub phase_rad: f64,
    /// Start, s.
    pub start_s: f64,
    /// `T`, s.
    pub duration_s: f64,
}

impl Chirp {
    /// Angle, rad, angular frequency, rad/s, and its rate, rad/s^2, at a time after the start.
    fn angle(&self, after_s: f64) -> [f64; 3] {
        let (f0, f1, length) = (self.from_hz, self.to_hz, self.duration_s);
        let octaves = (f1 / f0).ln();
        if self.sweep == FrequencySweep::Linear || octaves == 0.0 {
            let rate = (f1 - f0) / length;
            return [
                self.phase_rad + TAU * (f0 + 0.5 * rate * after_s) * after_s,
                TAU * (f0 + rate * after_s),
                TAU * rate,
            ];
        }
        let frequency_hz = f0 * (octaves * after_s / length).exp();
        let turns = f0 * length / octaves * (octaves * after_s / length).exp_m1();
        [
            self.phase_rad + TAU * turns,
            TAU * frequency_hz,
            TAU * frequency_hz * octaves / length,
        ]
    }
}

impl Chirp {
    /// Value at a time after the start.
    pub(super) fn size(&self, after_s: f64) -> f64 {
        self.amplitude * self.angle(after_s)[0].sin()
    }

    /// Samples of the second derivative, `A (p'' cos(p) - p'^2 sin(p))`; their correction omits
    /// terms in the square of `p''`.
    pub(super) fn acceleration(&self) -> Wave {
        self.sampled(|[angle, w, rate], step_s| {
            let (sin, cos) = angle.sin_cos();
            let x2 = (w * step_s).powi(2);
            self.amplitude
                * (rate * cos * (1.0 + x2 / 2.0)
                    - w * w * sin * (1.0 + x2 / 12.0 + x2 * x2 / 240.0))
        })
    }

    /// Samples from the angle, its rates and the step between samples, s.
    fn sampled(&self, sample: impl Fn([f64; 3], f64) -> f64) -> Wave {
        let lines =
            (self.duration_s * self.from_hz.max(self.to_hz) * DriveSignal::CHIRP_SAMPLES_PER_CYCLE)
                .ceil()
                .max(2.0) as usize;
        let step_s = self.duration_s / lines as f64;
        let sizes = (0..=lines).map(|k| sample(self.angle(k as f64 * step_s), step_s));
        Wave::Sampled {
            start_s: self.start_s,
            step_s,
            sizes: sizes.collect(),
        }
    }
}

/// Returns the samples of a chirp, 0 outside its duration.
///
/// # Limits The images of linear interpolation are 1.5e-5 of the amplitude, at 255 times the
/// highest frequency.
pub fn chirp(chirp: &Chirp) -> Wave {
    chirp.sampled(|[angle, w, rate], step_s| {
        let (sin, cos) = angle.sin_cos();
        let x = w * step_s;
        chirp.amplitude
            * (sin - (rate * step_s * step_s * cos - x * x * sin) / 12.0 + x.powi(4) / 240.0 * sin)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequency_is_the_rate_of_the_angle_and_ends_where_it_should() {
        for sweep in [FrequencySweep::Linear, FrequencySweep::Logarithmic] {
            let chirp = Chirp {
                amplitude: 1.0,
                from_hz: 5.0,
                to_hz: 40.0,
                sweep,
                phase_rad: 0.3,
                start_s: 0.0,
                duration_s: 2.0,
            };
            assert!(
                (chirp.angle(0.0)[1] / TAU - 5.0).abs() < 1e-12
                    && (chirp.angle(2.0)[1] / TAU - 40.0).abs() < 1e-12
            );
            for t in [0.3, 1.1, 1.9] {
                let d = 1e-5;
                let slope = (chirp.angle(t + d)[0] - chirp.angle(t - d)[0]) / (2.0 * d);
                let rate = (chirp.angle(t + d)[1] - chirp.angle(t - d)[1]) / (2.0 * d);
                assert!(
                    (slope / chirp.angle(t)[1] - 1.0).abs() < 1e-8
                        && (rate / chirp.angle(t)[2] - 1.0).abs() < 1e-8,
                    "{sweep:?} {t}"
                );
            }
        }
    }
}
