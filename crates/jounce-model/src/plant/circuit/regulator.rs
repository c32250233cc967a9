//! Regulator between a storage capacitor and a device.
//!
//! It starts where the storage voltage `V` reaches `V_start`, and stops where it falls to `V_stop`.
//! It draws from the storage the current
//!
//! ```text
//! off   i = I_idle V / V_start
//! on    i = V_out I_out / (n V) + I_q
//! ```
//!
//! with `I_out` the current of the device at the output voltage `V_out`, `n` the efficiency of the
//! converter, `I_idle` and `I_q` the quiescent currents. The first line is a conductance, which
//! remains in the plant while the regulator is on. The rest of the second line is held constant
//! over bands of the voltage, `V_stop (1 + b)^k` to `V_stop (1 + b)^(k+1)`, with `V` the middle of
//! the band: a voltage that passes a band then gives exactly the energy of the device divided by the
//! efficiency, because `C (V_2^2 - V_1^2) / 2 = C (V_2 - V_1) V`. Both limits of a band are events,
//! so that the flow between them is exact.

use jounce_spec::{Circuit, Spec};

/// `b`: the held current differs from that of the momentary voltage by at most half of it.
const BAND_WIDTH: f64 = 0.01;

/// A regulator and its device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Regulator {
    /// Storage voltage at which the regulator starts, V.
    pub start_v: f64,
    /// Storage voltage at which it stops, V.
    pub stop_v: f64,
    /// Output voltage, V.
    pub output_v: f64,
    /// Efficiency of the converter, 0 to 1.
    pub efficiency: f64,
    /// Current drawn while off, at the start voltage, A.
    pub idle_a: f64,
    /// Quiescent current while on, A.
    pub quiescent_a: f64,
    /// Duty cycle of the device, from the start of the regulator on.
    pub phases: [DevicePhase; 3],
}

/// Phase of the duty cycle of a device.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DevicePhase {
    /// Current at the output of the regulator, A.
    pub output_a: f64,
    /// Length, s; infinite for a device without a duty cycle, 0 for a phase that it does not have.
    pub length_s: f64,
}

/// Interval of the storage voltage over which the current is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VoltageBand {
    /// Lower limit, V.
    pub low_v: f64,
    /// Upper limit, V.
    pub high_v: f64,
    /// Current in addition to the conductance, A.
    pub held_a: f64,
}

impl Regulator {
    /// Phase in which the device sleeps; the others are its task.
    pub const SLEEP: usize = 2;

    /// Returns the regulator of a circuit with its device; `None` without one.
    pub fn of(spec: &Spec, circuit: &Circuit) -> Option<Self> {
        let regulator = spec.regulator.get(&circuit.regulator)?;
        let device = spec.device.get(&circuit.device)?;
        let phase = |output_a: Option<f64>, length_s: Option<f64>| DevicePhase {
            output_a: output_a.unwrap_or(0.0),
            length_s: length_s.unwrap_or(0.0),
        };
        let measure = phase(device.measure_a, device.measure_s);
        let send = phase(device.send_a, device.send_s);
        let sleep = DevicePhase {
            output_a: device.sleep_a,
            length_s: device.period_s.map_or(f64::INFINITY, |period_s| {
                period_s - measure.length_s - send.length_s
            }),
        };
        Some(Self {
            start_v: regulator.start_v,
            stop_v: regulator.stop_v,
            output_v: regulator.output_v,
            efficiency: regulator.efficiency,
            idle_a: regulator.idle_a,
            quiescent_a: regulator.quiescent_a,
            phases: [measure, send, sleep],
        })
    }

    /// Returns the conductance across the storage, 1/ohm.
    pub fn conductance_per_ohm(&self) -> f64 {
        self.idle_a / self.start_v
    }

    /// Returns the band while off. The lower limit is never reached: diodes do not discharge the
    /// storage.
    pub fn off_band(&self) -> VoltageBand {
        VoltageBand {
            low_v: -self.start_v,
            high_v: self.start_v,
            held_a: 0.0,
        }
    }

    /// Returns the index of the band of a voltage while on.
    pub fn band_index(&self, voltage_v: f64) -> i32 {
        let bands = (voltage_v / self.stop_v).ln() / BAND_WIDTH.ln_1p();
        (bands.floor() as i32).max(0)
    }

    /// Returns a band while on.
    pub fn band(&self, phase: usize, index: i32) -> VoltageBand {
        let edge_v = |index: i32| self.stop_v * (1.0 + BAND_WIDTH).powi(index);
        let (low_v, high_v) = (edge_v(index), edge_v(index + 1));
        let middle_v = 0.5 * (low_v + high_v);
        let device_a = self.output_w(phase) / (self.efficiency * middle_v);
        VoltageBand {
            low_v,
            high_v,
            held_a: device_a + self.quiescent_a - self.conductance_per_ohm() * middle_v,
        }
    }

    /// Returns the power delivered to the device in a phase, W.
    pub fn output_w(&self, phase: usize) -> f64 {
        self.output_v * self.phases[phase].output_a
    }

    /// Returns the first phase.
    pub fn first_phase(&self) -> usize {
        self.next_from(0)
    }

    /// Returns the phase after another one.
    pub fn phase_after(&self, phase: usize) -> usize {
        self.next_from(phase + 1)
    }

    /// Returns the first phase with a length, from one on.
    fn next_from(&self, phase: usize) -> usize {
        let count = self.phases.len();
        (phase..phase + count)
            .map(|index| index % count)
            .find(|index| self.phases[*index].length_s > 0.0)
            .unwrap_or(0)
    }

    /// Returns the mean power that the regulator draws if it never stops, W, at the mean of its two
    /// threshold voltages.
    pub fn needed_w(&self) -> f64 {
        let storage_v = 0.5 * (self.start_v + self.stop_v);
        self.mean_output_w() / self.efficiency + self.quiescent_a * storage_v
    }

    /// Returns the mean power of the device while the regulator is on, W.
    pub fn mean_output_w(&self) -> f64 {
        let last = self.phases.len() - 1;
        if self.phases[last].length_s.is_infinite() {
            return self.output_w(last);
        }
        let (mut energy_j, mut length_s) = (0.0, 0.0);
        for (index, phase) in self.phases.iter().enumerate() {
            energy_j += self.output_w(index) * phase.length_s;
            length_s += phase.length_s;
        }
        energy_j / length_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn regulator() -> Regulator {
        let phase = |output_a, length_s| DevicePhase { output_a, length_s };
        Regulator {
            start_v: 5.0,
            stop_v: 3.6,
            output_v: 3.3,
            efficiency: 0.8,
            idle_a: 0.5e-6,
            quiescent_a: 1e-6,
            phases: [phase(2e-3, 0.02), phase(0.0, 0.0), phase(1e-6, 9.98)],
        }
    }

    #[test]
    fn bands_join_and_hold_every_voltage() {
        let regulator = regulator();
        for k in 0..400 {
            let (this, next) = (regulator.band(0, k), regulator.band(0, k + 1));
            assert_eq!(this.high_v, next.low_v);
            assert!(next.held_a < this.held_a);
            let middle_v = 0.5 * (this.low_v + this.high_v);
            assert_eq!(regulator.band_index(middle_v), k);
        }
        assert_eq!(regulator.band(0, 0).low_v, regulator.stop_v);
        assert_eq!(regulator.band_index(3.0), 0);
    }

    /// The total current in the middle of a band is that of the device and the quiescent current.
    #[test]
    fn the_middle_of_a_band_has_the_exact_current() {
        let regulator = regulator();
        let band = regulator.band(0, 7);
        let middle_v = 0.5 * (band.low_v + band.high_v);
        let drawn_a = band.held_a + regulator.conductance_per_ohm() * middle_v;
        let wanted_a = 3.3 * 2e-3 / (0.8 * middle_v) + 1e-6;
        assert!((drawn_a - wanted_a).abs() < 1e-15 * wanted_a.abs() + 1e-18);
    }

    #[test]
    fn phases_without_a_length_are_passed_over() {
        let regulator = regulator();
        assert_eq!(regulator.first_phase(), 0);
        assert_eq!(regulator.phase_after(0), 2);
        assert_eq!(regulator.phase_after(2), 0);
        let mean_w = 3.3 * (2e-3 * 0.02 + 1e-6 * 9.98) / 10.0;
        assert!((regulator.mean_output_w() - mean_w).abs() < 1e-15);
    }
}
