//! Fraction of the energy of a blow that reaches the resistor: one mode, one patch, one velocity
//! impulse.
//!
//! ```text
//! eta = alpha kappa^2 / [(2 zeta alpha^2 + alpha) kappa^2 + 4 zeta^2 alpha + 2 (alpha^2 + 1) zeta]
//! best alpha = 1 / sqrt(1 + kappa^2),   best eta = kappa^2 / (kappa^2 + 4 zeta sqrt(1 + kappa^2) + 4 zeta^2)
//! ```
//!
//! `alpha = w0 C R`, `kappa^2 = theta^2 / (m w0^2 C)`, `zeta` the damping ratio; `eta` is the
//! energy in the resistor over `m v^2 / 2`. Source: derived from the Lyapunov equation of the
//! coupled system, with the algebra of Adhikari, Friswell and Inman, Smart Mater. Struct. 18 (2009)
//! 115005.

use super::{PiezoResistor, Reference};

/// Blow on a piezoelectric oscillator with a resistor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// `alpha`.
    pub alpha: f64,
    /// `kappa^2`.
    pub coupling_squared: f64,
    /// `zeta`, 1 = critical.
    pub damping_ratio: f64,
}

impl Reference for Impulse {
    const SOURCE: &'static str = "derived from the Lyapunov equation; algebra of Adhikari et al., Smart Mater. Struct. 18 (2009) 115005";
    const TOLERANCE: f64 = 1e-10;
}

impl Impulse {
    /// `eta`, 0 to 1.
    pub fn efficiency(&self) -> f64 {
        let Self {
            alpha,
            coupling_squared,
            damping_ratio: zeta,
        } = *self;
        alpha * coupling_squared
            / ((2.0 * zeta * alpha * alpha + alpha) * coupling_squared
                + 4.0 * zeta * zeta * alpha
                + 2.0 * (alpha * alpha + 1.0) * zeta)
    }

    /// The `alpha` of the best resistance.
    pub fn best_alpha(&self) -> f64 {
        1.0 / (1.0 + self.coupling_squared).sqrt()
    }

    /// `eta` at the best resistance.
    pub fn best_efficiency(&self) -> f64 {
        let (k, zeta) = (self.coupling_squared, self.damping_ratio);
        k / (k + 4.0 * zeta * (1.0 + k).sqrt() + 4.0 * zeta * zeta)
    }

    /// Returns an oscillator of unit mass, unit frequency (rad/s) and unit capacitance with these
    /// numbers; any initial velocity may be used.
    pub fn oscillator(&self) -> PiezoResistor {
        PiezoResistor {
            mass_kg: 1.0,
            frequency_rad_s: 1.0,
            damping_ratio: self.damping_ratio,
            coupling_n_per_v: self.coupling_squared.sqrt(),
            capacitance_f: 1.0,
            resistance_ohm: self.alpha,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn efficiency_of_two_oscillators() {
        for (damping_ratio, coupling_squared, alpha, eta, best) in [
            (0.01, 0.1, 1.0, 0.702247191, 0.702482),
            (0.005, 0.02, 0.5, 0.442477876, 0.496290),
        ] {
            let blow = Impulse {
                alpha,
                coupling_squared,
                damping_ratio,
            };
            assert!(
                (blow.efficiency() - eta).abs() < 1e-9,
                "{}",
                blow.efficiency()
            );
            assert!(
                (blow.best_efficiency() - best).abs() < 1e-6,
                "{}",
                blow.best_efficiency()
            );
            let at_best = Impulse {
                alpha: blow.best_alpha(),
                ..blow
            };
            assert!((at_best.efficiency() / blow.best_efficiency() - 1.0).abs() < 1e-14);
        }
    }
}
