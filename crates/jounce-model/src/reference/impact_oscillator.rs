//! Periodic orbits of a driven oscillator with a rigid stop: one impact in `n` cycles of the drive.
//!
//! ```text
//! x'' + 2 zeta x' + x = cos(w t),   x <= d,   x'_after = -r x'_before
//! ```
//!
//! in units of the mass, of the frequency and of the drive (1 kg, 1 rad/s, 1 N). With
//! `P = e^{A T}`, `T = 2 pi n / w`, the steady motion `(p, s)` at the impact obeys `p = d - k0 v`,
//! `s = k1 v`, `[P11 - 1, -P12; P21, 1 - P22] k = [P12 r; 1 + P22 r]`, and the impact speed `v`
//! solves `(d - k0 v)^2 + (k1 v / w)^2 = X^2`, `X = 1 / sqrt((1 - w^2)^2 + (2 zeta w)^2)`. The
//! orbit is stable when the eigenvalues of `P S`, `S = [[-r, 0], [(a+ + r a-) / v, -r]]`, lie
//! inside the unit circle, with `a` the accelerations before (-) and after (+) the impact. The
//! condition `x < d` between the impacts is not checked.
//!
//! Source: Shaw and Holmes, J. Sound Vib. 90 (1983) 129.

use super::Reference;
use super::single_mode::{oscillator, shape, state, with_stop};
use crate::contact::{Law, Rigid};
use crate::plant::{BlockPair, Drive, System};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Driven oscillator with a rigid stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactOscillator {
    /// `w`, drive frequency over natural frequency.
    pub frequency_ratio: f64,
    /// `zeta`, below 1.
    pub damping_ratio: f64,
    /// `r`.
    pub restitution: f64,
    /// `d`, in units of the static deflection.
    pub gap: f64,
}

/// Periodic orbit with one impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactOrbit {
    /// Drive cycles per impact.
    pub cycles: u32,
    /// `v`, speed just before the impact.
    pub speed: f64,
    /// Angle `w t` of the drive's cosine at the impact, rad, 0 to 2 pi.
    pub angle_rad: f64,
    /// Trace and determinant of the map from impact to impact, linearised.
    pub trace_determinant: [f64; 2],
}

impl Reference for ImpactOscillator {
    const SOURCE: &'static str = "Shaw and Holmes, J. Sound Vib. 90 (1983) 129";
    const TOLERANCE: f64 = 1e-9;
}

impl ImpactOscillator {
    /// Returns the system to integrate; its drive starts at `angle_rad` of the cosine.
    pub fn system(&self, angle_rad: f64) -> System {
        let law = Law::Rigid(Rigid {
            restitution: self.restitution,
        });
        let mut system = with_stop(oscillator(1.0, 1.0, self.damping_ratio), 1.0, self.gap, law);
        system.drives.push(Drive {
            name: "drive".to_owned(),
            shape: shape(1.0),
            amplitude_n: 1.0,
            frequency_hz: self.frequency_ratio / TAU,
            phase_rad: angle_rad + FRAC_PI_2,
            base: None,
        });
        system
    }

    /// Returns the state `(q, q')` just after the impact of an orbit.
    pub fn start(&self, orbit: &ImpactOrbit) -> Vec<f64> {
        state(1.0, self.gap, -self.restitution * orbit.speed)
    }

    /// `X`, the amplitude without the stop; grazing occurs where it equals the gap.
    pub fn steady_amplitude(&self) -> f64 {
        let w = self.frequency_ratio;
        1.0 / (1.0 - w * w).hypot(2.0 * self.damping_ratio * w)
    }

    /// Returns all orbits with one impact in `cycles` cycles of the drive, slowest impact first.
    pub fn orbits(&self, cycles: u32) -> Vec<ImpactOrbit> {
        let (w, r, d) = (self.frequency_ratio, self.restitution, self.gap);
        let map = self.flow(TAU * f64::from(cycles) / w);
        let [p11, p12, p21, p22] = map;
        let det = (p11 - 1.0) * (1.0 - p22) + p12 * p21;
        let (right0, right1) = (p12 * r, 1.0 + p22 * r);
        let k0 = (right0 * (1.0 - p22) + p12 * right1) / det;
        let k1 = ((p11 - 1.0) * right1 - p21 * right0) / det;
        let (square, half) = (k0 * k0 + (k1 / w).powi(2), d * k0);
        let rest = (d - self.steady_amplitude()) * (d + self.steady_amplitude());
        let discriminant = half * half - square * rest;
        if discriminant.is_nan() || discriminant < 0.0 {
            return Vec::new();
        }
        let speeds = [
            (half - discriminant.sqrt()) / square,
            (half + discriminant.sqrt()) / square,
        ];
        let valid = speeds.into_iter().filter(|v| *v > 0.0);
        valid
            .map(|speed| self.orbit(cycles, speed, [d - k0 * speed, k1 * speed], &map))
            .collect()
    }

    fn orbit(&self, cycles: u32, speed: f64, [p, s]: [f64; 2], map: &[f64; 4]) -> ImpactOrbit {
        let (w, zeta, r) = (self.frequency_ratio, self.damping_ratio, self.restitution);
        let lag = (2.0 * zeta * w).atan2(1.0 - w * w);
        let angle_rad = ((-s / w).atan2(p) + lag).rem_euclid(TAU);
        let before = angle_rad.cos() - 2.0 * zeta * speed - self.gap;
        let after = angle_rad.cos() + 2.0 * zeta * r * speed - self.gap;
        let kick = (after + r * before) / speed;
        let [p11, p12, p21, p22] = *map;
        let product = [
            -r * p11 + kick * p12,
            -r * p12,
            -r * p21 + kick * p22,
            -r * p22,
        ];
        let determinant = product[0] * product[3] - product[1] * product[2];
        ImpactOrbit {
            cycles,
            speed,
            angle_rad,
            trace_determinant: [product[0] + product[3], determinant],
        }
    }

    /// `e^{A t}` on displacement and velocity, row by row.
    fn flow(&self, time: f64) -> [f64; 4] {
        let zeta = self.damping_ratio;
        let frequency = ((1.0 - zeta) * (1.0 + zeta)).sqrt();
        let [ec, _, es, _] = BlockPair::Oscillatory {
            decay: -zeta,
            frequency,
        }
        .flow(time);
        let es = es / frequency;
        [ec + zeta * es, es, -es, ec - zeta * es]
    }
}

impl ImpactOrbit {
    /// True when both multipliers lie inside the unit circle (Jury).
    pub fn is_stable(&self) -> bool {
        let [trace, determinant] = self.trace_determinant;
        determinant.abs() < 1.0 && trace.abs() < 1.0 + determinant
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only(oscillator: &ImpactOscillator) -> ImpactOrbit {
        let orbits = oscillator.orbits(1);
        assert_eq!(orbits.len(), 1);
        orbits[0]
    }

    #[test]
    fn undamped_orbit_at_twice_the_frequency_is_twenty_thirds() {
        let orbit = only(&ImpactOscillator {
            frequency_ratio: 2.0,
            damping_ratio: 0.0,
            restitution: 0.8,
            gap: 0.0,
        });
        assert!(
            (orbit.speed * 0.15 - 1.0).abs() < 1e-12 && (orbit.angle_rad - FRAC_PI_2).abs() < 1e-12,
            "{orbit:?}"
        );
        // Both multipliers are 0.8.
        assert!(
            (orbit.trace_determinant[0] - 1.6).abs() < 1e-12 && orbit.is_stable(),
            "{orbit:?}"
        );
    }

    #[test]
    fn damped_orbit_of_the_table() {
        let oscillator = ImpactOscillator {
            frequency_ratio: 0.8,
            damping_ratio: 0.05,
            restitution: 0.8,
            gap: 0.5,
        };
        let orbit = only(&oscillator);
        assert!(
            (orbit.speed - 2.31801966).abs() < 1e-8 && (orbit.angle_rad - 6.06348171).abs() < 1e-8,
            "{orbit:?}"
        );
        assert!(
            (orbit.trace_determinant[0] - 0.239250792).abs() < 1e-9,
            "{orbit:?}"
        );
        let exact = 0.64 * (-0.1 * TAU / 0.8_f64).exp();
        assert!(
            (orbit.trace_determinant[1] / exact - 1.0).abs() < 1e-12 && orbit.is_stable(),
            "{orbit:?}"
        );
        assert!((oscillator.steady_amplitude() - 2.711631).abs() < 1e-6);
    }

    /// Shaw and Holmes find the period doubling of this orbit near 2.65.
    #[test]
    fn the_orbit_at_twice_the_frequency_doubles_where_it_was_published() {
        let stable = |w: f64| {
            only(&ImpactOscillator {
                frequency_ratio: w,
                damping_ratio: 0.0,
                restitution: 0.8,
                gap: 0.0,
            })
            .is_stable()
        };
        assert!(stable(1.90) && stable(2.65) && !stable(2.66));
    }
}
