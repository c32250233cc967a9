//! Ball that bounces once in `n` cycles on a table in vertical sinusoidal motion, with restitution
//! `e`.
//!
//! In units of the angular frequency of the table and of gravity (1 rad/s, 1 m/s^2), with the table
//! at `G sin th`:
//!
//! ```text
//! cos th = n pi (1 - e) / (G (1 + e)),  speed of the ball after the bounce = n pi;  exists for  G >= n pi (1 - e) / (1 + e)
//! trace = 1 + e^2 - (1 + e)^2 G sin th,  determinant = e^2   of the map from bounce to bounce
//! doubles at  G^2 = [n pi (1 - e) / (1 + e)]^2 + [2 (1 + e^2) / (1 + e)^2]^2
//! ```
//!
//! A ball under gravity is a mass at the end of a soft, highly stretched spring. With the stiffness
//! `s` and the stop at `-1 / s` the spring pulls it to the stop with force 1, and the drive is the
//! acceleration of the table. The residual effect of the spring is of order `s`.
//!
//! Source: P. J. Holmes, J. Sound Vib. 84 (1982) 173, here including the displacement of the table
//! in the time of flight.

use super::Reference;
use super::root::between;
use super::single_mode::{oscillator, shape, state, with_stop};
use crate::contact::{Law, Rigid};
use crate::plant::{Drive, System};
use std::f64::consts::{PI, TAU};

/// Samples per cycle of the table in the search for the next bounce.
const LOOKS: f64 = 1000.0;

/// Ball on a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BouncingTable {
    /// `e`.
    pub restitution: f64,
    /// `G`, peak acceleration of the table over gravity.
    pub acceleration_ratio: f64,
}

/// Periodic orbit with one bounce.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableOrbit {
    /// `n`, cycles of the table per bounce.
    pub cycles: u32,
    /// `th`, angle of the table's sine at the bounce, rad.
    pub angle_rad: f64,
    /// Speed of the ball just after the bounce, upwards.
    pub speed: f64,
    /// Trace and determinant of the map from bounce to bounce, linearised.
    pub trace_determinant: [f64; 2],
}

impl Reference for BouncingTable {
    const SOURCE: &'static str =
        "Holmes, J. Sound Vib. 84 (1982) 173, with the exact time of flight";
    const TOLERANCE: f64 = 1e-9;
}

impl BouncingTable {
    /// Returns the system, with the ball on a spring of stiffness `softness`; the drive starts at
    /// `angle_rad` of the table's sine.
    pub fn system(&self, softness: f64, angle_rad: f64) -> System {
        let law = Law::Rigid(Rigid {
            restitution: self.restitution,
        });
        let mut system = with_stop(
            oscillator(1.0, softness.sqrt(), 0.0),
            1.0,
            -1.0 / softness,
            law,
        );
        // Down is positive. In the frame of the table the ball has minus the acceleration of the
        // table upwards, `-G sin th` downwards.
        system.drives.push(Drive {
            name: "table".to_owned(),
            shape: shape(1.0),
            amplitude_n: self.acceleration_ratio,
            frequency_hz: 1.0 / TAU,
            phase_rad: angle_rad + PI,
            base: None,
        });
        system
    }

    /// Returns the state `(q, q')` of that system just after the bounce of an orbit.
    pub fn start(&self, softness: f64, orbit: &TableOrbit) -> Vec<f64> {
        state(
            1.0,
            -1.0 / softness,
            self.acceleration_ratio * orbit.angle_rad.cos() - orbit.speed,
        )
    }

    /// Least `G` at which an orbit of `cycles` exists.
    pub fn existence(&self, cycles: u32) -> f64 {
        f64::from(cycles) * PI * (1.0 - self.restitution) / (1.0 + self.restitution)
    }

    /// `G` at which the orbit doubles its period.
    pub fn doubling(&self, cycles: u32) -> f64 {
        let e = self.restitution;
        self.existence(cycles)
            .hypot(2.0 * (1.0 + e * e) / (1.0 + e).powi(2))
    }

    /// Returns the orbit that is stable from its first `G` to its doubling; `None` below the first.
    pub fn orbit(&self, cycles: u32) -> Option<TableOrbit> {
        let (e, g) = (self.restitution, self.acceleration_ratio);
        let angle_rad = (self.existence(cycles) / g).acos();
        let trace = 1.0 + e * e - (1.0 + e).powi(2) * g * angle_rad.sin();
        let orbit = TableOrbit {
            cycles,
            angle_rad,
            speed: f64::from(cycles) * PI,
            trace_determinant: [trace, e * e],
        };
        (!angle_rad.is_nan()).then_some(orbit)
    }

    /// Returns angle and speed after the next bounce, by a search for the first time at which ball
    /// and table meet.
    pub fn next(&self, angle_rad: f64, speed: f64) -> (f64, f64) {
        let (e, g) = (self.restitution, self.acceleration_ratio);
        let height =
            |t: f64| g * (angle_rad.sin() - (angle_rad + t).sin()) + speed * t - 0.5 * t * t;
        let step = TAU / LOOKS;
        let mut to = step;
        while height(to) > 0.0 {
            to += step;
        }
        let flight = between(height, to - step, to);
        let angle_rad = angle_rad + flight;
        (
            angle_rad.rem_euclid(TAU),
            (1.0 + e) * g * angle_rad.cos() - e * (speed - flight),
        )
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_those_of_the_table() {
        for (restitution, existence, doubling) in
            [(0.5, PI / 3.0, 1.526823701), (0.8, PI / 9.0, 1.070836468)]
        {
            let table = BouncingTable {
                restitution,
                acceleration_ratio: doubling,
            };
            assert!(
                (table.existence(1) - existence).abs() < 1e-9
                    && (table.doubling(1) - doubling).abs() < 1e-9
            );
            let [trace, determinant] = table.orbit(1).unwrap().trace_determinant;
            assert!(
                (1.0 + trace + determinant).abs() < 1e-8,
                "{trace} {determinant}"
            );
            let below = BouncingTable {
                acceleration_ratio: 0.999 * existence,
                ..table
            };
            assert_eq!(below.orbit(1), None);
        }
    }

    /// Maps bounce by bounce: the orbit returns, and differences of the map give trace and
    /// determinant to 1e-8.
    #[test]
    fn the_orbit_is_a_fixed_point_of_the_bounces_with_these_multipliers() {
        for (restitution, acceleration_ratio, cycles) in
            [(0.5, 1.3, 1), (0.8, 0.9, 1), (0.8, 1.2, 2)]
        {
            let table = BouncingTable {
                restitution,
                acceleration_ratio,
            };
            let orbit = table.orbit(cycles).unwrap();
            let next = table.next(orbit.angle_rad, orbit.speed);
            assert!(
                (next.0 - orbit.angle_rad).abs() < 1e-12 && (next.1 - orbit.speed).abs() < 1e-12,
                "{next:?}"
            );
            let h = 1e-5;
            let (right, left_side) = (
                table.next(orbit.angle_rad + h, orbit.speed),
                table.next(orbit.angle_rad - h, orbit.speed),
            );
            let (up, down) = (
                table.next(orbit.angle_rad, orbit.speed + h),
                table.next(orbit.angle_rad, orbit.speed - h),
            );
            let difference = |a: f64, b: f64| (a - b) / (2.0 * h);
            let matrix = [
                difference(right.0, left_side.0),
                difference(up.0, down.0),
                difference(right.1, left_side.1),
                difference(up.1, down.1),
            ];
            let [trace, determinant] = orbit.trace_determinant;
            assert!(
                (matrix[0] + matrix[3] - trace).abs() < 1e-7,
                "{matrix:?} {trace}"
            );
            assert!(
                (matrix[0] * matrix[3] - matrix[1] * matrix[2] - determinant).abs() < 1e-7,
                "{matrix:?}"
            );
        }
    }

    /// Difference between alternate bounces after many: zero below the doubling, clearly nonzero
    /// above it.
    #[test]
    fn bounces_settle_on_one_height_below_the_doubling_and_on_two_above() {
        let distance = |factor: f64| {
            let table = BouncingTable {
                restitution: 0.5,
                acceleration_ratio: 1.526823701 * factor,
            };
            let orbit = table.orbit(1).unwrap();
            let mut at = (orbit.angle_rad + 1e-3, orbit.speed);
            (0..4000).for_each(|_| at = table.next(at.0, at.1));
            let after = table.next(at.0, at.1);
            let next_impact = table.next(after.0, after.1);
            assert!(
                (next_impact.1 - at.1).abs() < 1e-6,
                "{at:?} {next_impact:?}"
            );
            (after.1 - at.1).abs()
        };
        assert!(
            distance(0.99) < 1e-6 && distance(1.01) > 0.05,
            "{} {}",
            distance(0.99),
            distance(1.01)
        );
    }
}
