//! Mass on a spring whose patch feeds a resistor, under a sinusoidal force or white noise.
//!
//! ```text
//! m (x'' + 2 zeta w0 x' + w0^2 x) - theta V = F(t),     C V' + V / R + theta x' = 0
//! alpha = w0 C R,   kappa^2 = theta^2 / (m w0^2 C)
//! V / F = -i w theta / [ (1/R + i w C) m (w0^2 - w^2 + 2 i zeta w0 w) + i w theta^2 ]
//! ```
//!
//! Optimal loads: at the short-circuit resonance `R w0 C = 1 / sqrt(1 + (kappa^2 / 2 zeta)^2)`.
//! White base acceleration of two-sided density `Phi` (m^2 s^-4 per rad/s) gives the mean power `pi
//! m alpha kappa^2 Phi / [(2 zeta alpha^2 + alpha) kappa^2 + 4 zeta^2 alpha + 2 (alpha^2 + 1)
//! zeta]`.
//!
//! Sources: Erturk and Inman, J. Vib. Acoust. 130 (2008) 041002, one mode; Adhikari, Friswell and
//! Inman, Smart Mater. Struct. 18 (2009) 115005, eq. for the harvester without inductor.

use super::Reference;
use super::single_mode::{PATCH, oscillator, shape};
use crate::plant::{Drive, Load, System};
use crate::structure::PatchModes;
use jounce_linalg::c64;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// One mode, one patch, one resistor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PiezoResistor {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `w0`, short-circuit, rad/s.
    pub frequency_rad_s: f64,
    /// `zeta`, 1 = critical.
    pub damping_ratio: f64,
    /// `theta`, N/V.
    pub coupling_n_per_v: f64,
    /// `C`, F.
    pub capacitance_f: f64,
    /// `R`, ohm.
    pub resistance_ohm: f64,
}

impl Reference for PiezoResistor {
    const SOURCE: &'static str = "Erturk and Inman, J. Vib. Acoust. 130 (2008) 041002; Adhikari, Friswell and Inman, Smart Mater. Struct. 18 (2009) 115005";
    const TOLERANCE: f64 = 1e-11;
}

impl PiezoResistor {
    /// Returns the system under a force `amplitude sin(2 pi f t)` on the mass.
    pub fn system(&self, amplitude_n: f64, drive_hz: f64) -> System {
        let mut system = oscillator(self.mass_kg, self.frequency_rad_s, self.damping_ratio);
        let coupling_n_per_v = vec![self.coupling_n_per_v / self.mass_kg.sqrt()];
        Arc::make_mut(&mut system.modes).patch.insert(
            PATCH.to_owned(),
            PatchModes {
                coupling_n_per_v,
                capacitance_f: self.capacitance_f,
                leakage_ohm: None,
                strain: Vec::new(),
            },
        );
        system
            .loads
            .push(Load::resistor("load", PATCH, self.resistance_ohm));
        system.drives.push(Drive {
            name: "drive".to_owned(),
            shape: shape(self.mass_kg),
            amplitude_n,
            frequency_hz: drive_hz,
            phase_rad: 0.0,
            base: None,
        });
        system
    }

    /// `alpha`, the time constant of the circuit in radians of the oscillator.
    pub fn alpha(&self) -> f64 {
        self.frequency_rad_s * self.capacitance_f * self.resistance_ohm
    }

    /// `kappa^2`.
    pub fn coupling_squared(&self) -> f64 {
        self.coupling_n_per_v.powi(2)
            / (self.mass_kg * self.frequency_rad_s.powi(2) * self.capacitance_f)
    }

    /// Complex voltage per newton at a drive frequency, V/N, in `e^{+i w t}`.
    pub fn voltage_per_newton(&self, drive_hz: f64) -> c64 {
        let (w0, w) = (self.frequency_rad_s, TAU * drive_hz);
        let mechanical =
            c64::new((w0 - w) * (w0 + w), 2.0 * self.damping_ratio * w0 * w) * self.mass_kg;
        let electrical = c64::new(1.0 / self.resistance_ohm, w * self.capacitance_f);
        c64::new(0.0, -w * self.coupling_n_per_v)
            / (electrical * mechanical + c64::new(0.0, w * self.coupling_n_per_v.powi(2)))
    }

    /// Mean power in the resistor under a force of the given amplitude (zero to peak), W.
    pub fn mean_power_w(&self, amplitude_n: f64, drive_hz: f64) -> f64 {
        0.5 * self.voltage_per_newton(drive_hz).norm_sqr() * amplitude_n.powi(2)
            / self.resistance_ohm
    }

    /// Resistance with the largest power at the short-circuit resonance, ohm.
    pub fn best_resistance_short_circuit_ohm(&self) -> f64 {
        let ratio = self.coupling_squared() / (2.0 * self.damping_ratio);
        1.0 / (self.frequency_rad_s * self.capacitance_f * 1f64.hypot(ratio))
    }

    /// Mean power under white base acceleration of unit two-sided density (1 m^2 s^-4 per rad/s),
    /// W.
    pub fn white_noise_power_w(&self) -> f64 {
        let impulse = super::Impulse {
            alpha: self.alpha(),
            coupling_squared: self.coupling_squared(),
            damping_ratio: self.damping_ratio,
        };
        // White noise is a train of impulses: each square metre per second squared carries the
        // energy pi m.
        PI * self.mass_kg * impulse.efficiency()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uses the harvester of duToit and Wardle in the symbols of Adhikari et al.; numbers checked
    /// against the Lyapunov equation.
    #[test]
    fn white_noise_power_of_the_published_harvester() {
        let harvester = PiezoResistor {
            mass_kg: 9.12e-3,
            frequency_rad_s: (4.1e3_f64 / 9.12e-3).sqrt(),
            damping_ratio: 0.218 / (2.0 * (4.1e3_f64 * 9.12e-3).sqrt()),
            coupling_n_per_v: -4.57e-3,
            capacitance_f: 4.3e-8,
            resistance_ohm: 3e4,
        };
        assert!(
            (harvester.alpha() - 0.864936).abs() < 1e-6,
            "{}",
            harvester.alpha()
        );
        assert!(
            (harvester.coupling_squared() - 0.118462).abs() < 1e-6,
            "{}",
            harvester.coupling_squared()
        );
        assert!(
            (harvester.white_noise_power_w() / 0.017366529 - 1.0).abs() < 1e-7,
            "{}",
            harvester.white_noise_power_w()
        );
    }
}
