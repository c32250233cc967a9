//! Warped frequencies, at which one-sided spectra of samples have the form of responses: `W = 2/T
//! tan(w T / 2)`.

use std::f64::consts::{PI, TAU};

use jounce_linalg::c64;

use crate::modal::{Identification, Pole};

/// Minimum damping of an initial pole.
const MIN_START_DAMPING: f64 = 1e-4;

/// Removes the damping of the window from the pole of a decay.
pub(super) fn without_decay(pole: Pole, decay_per_s: f64) -> Pole {
    let p = pole.complex();
    Pole::of(c64::new(
        (p.re + decay_per_s).min(-MIN_START_DAMPING * p.im),
        p.im,
    ))
}

/// Conversion between frequencies and warped ones.
pub(super) struct Warp {
    pub rate_hz: f64,
}

impl Warp {
    pub fn warp_hz(&self, frequency_hz: f64) -> f64 {
        self.rate_hz / PI * (PI * frequency_hz / self.rate_hz).tan()
    }

    fn unwarp_hz(&self, warped_hz: f64) -> f64 {
        self.rate_hz / PI * (PI * warped_hz / self.rate_hz).atan()
    }

    fn pole(&self, pole: Pole) -> Pole {
        // atanh(x) = ln((1 + x) / (1 - x)) / 2
        let x = pole.complex() / (2.0 * self.rate_hz);
        Pole::of(((1.0 + x) / (1.0 - x)).ln() * self.rate_hz)
    }

    pub fn warped(&self, pole: Pole) -> Pole {
        Pole::of((pole.complex() / (2.0 * self.rate_hz)).tanh() * (2.0 * self.rate_hz))
    }

    pub fn unwarp(&self, result: &mut Identification) {
        for mode in &mut result.modes {
            let warped_hz = mode.frequency_hz;
            let pole = self.pole(Pole {
                frequency_hz: warped_hz,
                damping_ratio: mode.damping_ratio,
            });
            // d(w)/d(W) = cos^2(w T / 2), to the order of the damping.
            let slope = (TAU * pole.frequency_hz / (2.0 * self.rate_hz))
                .cos()
                .powi(2);
            mode.frequency_deviation_hz *= slope;
            mode.damping_deviation *= slope * warped_hz / pole.frequency_hz;
            (mode.frequency_hz, mode.damping_ratio) = (pole.frequency_hz, pole.damping_ratio);
        }
        result
            .frequency_hz
            .iter_mut()
            .for_each(|frequency_hz| *frequency_hz = self.unwarp_hz(*frequency_hz));
    }
}
