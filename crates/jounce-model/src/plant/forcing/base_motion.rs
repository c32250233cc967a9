//! Effect of base motions on the gaps between bases.
//!
//! Displacements are relative to the base under a body. If the two sides of a stop are on two
//! bases, the displacement towards the stop is
//!
//! ```text
//! shape . q + sum_b share_b X_b(t)
//! ```
//!
//! with `X_b` the displacement of base `b` (m) and `share_b` 1 or -1. For a sinusoidal acceleration
//! `a` the displacement is `-a / w^2`, the solution without drift. For any other signal it is the
//! double integral, from rest at 0 before the signal begins. The bases do the work `integral f
//! sum_b share_b X_b' dt` of the contact force `f`, in addition to the work of the inertial forces.

use crate::drive::{Travel, Wave};
use crate::plant::{Plant, Stop};
use jounce_linalg::c64;
use std::f64::consts::TAU;
use std::sync::Arc;

impl Stop {
    /// Displacement towards the stop per displacement of a base.
    pub(in crate::plant) fn share_of(&self, base: Option<&String>) -> f64 {
        self.bases
            .iter()
            .filter(|(name, _)| Some(name) == base)
            .map(|(_, share)| share)
            .sum()
    }
}

impl Plant {
    /// Returns the complex displacement towards a stop due to the base motions under each tone, m.
    pub(in crate::plant) fn approach_of_tones(&self, stop: &Stop) -> Vec<c64> {
        let mut sums = vec![c64::new(0.0, 0.0); self.tones.len()];
        for drive in &self.system.drives {
            let (w, share) = (TAU * drive.frequency_hz, stop.share_of(drive.base.as_ref()));
            let tones = self
                .tones
                .iter()
                .zip(&mut sums)
                .filter(|(tone, _)| share != 0.0 && tone.angular_frequency_rad_s == w);
            // X sin(w t + a) = Re(-i X e^{i a} e^{i w t}), X = -acceleration / w^2
            tones.for_each(|(_, sum)| {
                *sum +=
                    c64::new(0.0, share * drive.amplitude_n / (w * w)) * c64::cis(drive.phase_rad)
            });
        }
        sums
    }

    /// Returns the displacement towards a stop per displacement of the base that each signal moves.
    fn approach_of_signals(&self, stop: &Stop) -> Vec<f64> {
        self.system
            .signals
            .iter()
            .map(|signal| stop.share_of(signal.base.as_ref()))
            .collect()
    }

    /// Stores in every port the effect of the signals on its gap, and computes the displacements of
    /// the bases.
    pub(in crate::plant) fn approach(&mut self) {
        let shares: Vec<Vec<f64>> = self
            .system
            .stops
            .iter()
            .map(|stop| self.approach_of_signals(stop))
            .collect();
        let matters = |signal: usize| {
            shares
                .iter()
                .any(|shares_of_port| shares_of_port[signal] != 0.0)
        };
        let travel = |(k, wave): (usize, &Wave)| {
            (matters(k) && !wave.is_constant()).then(|| Arc::new(Travel::of(wave)))
        };
        self.travels = self
            .system
            .signals
            .iter()
            .map(|signal| &signal.wave)
            .enumerate()
            .map(travel)
            .collect();
        self.ports
            .iter_mut()
            .zip(shares)
            .for_each(|(port, shares_of_port)| port.approach = shares_of_port);
    }

    /// Returns the displacement towards a stop due to the base motions at a time, m.
    pub fn approached_m(&self, stop: usize, time_s: f64) -> f64 {
        let Some(port) = self.ports.get(stop) else {
            return 0.0;
        };
        let phasor = |(tone, x): (&crate::plant::Tone, &c64)| {
            (x * c64::cis(tone.angular_frequency_rad_s * time_s)).re
        };
        let tones: f64 = self.tones.iter().zip(&port.approach_m).map(phasor).sum();
        let signals = self
            .system
            .signals
            .iter()
            .zip(&self.travels)
            .zip(&port.approach);
        let travelled = signals.filter_map(|((signal, travel), share)| {
            let index = signal.wave.index_at(time_s);
            Some(
                share
                    * travel
                        .as_ref()?
                        .at(index, &signal.wave.piece(index), time_s)[0],
            )
        });
        tones + travelled.sum::<f64>()
    }

    /// Returns the first stop between two bases, by name.
    pub fn stop_between_bases(&self) -> Option<&str> {
        self.system
            .stops
            .iter()
            .find(|stop| !stop.bases.is_empty())
            .map(|stop| stop.name.as_str())
    }
}
