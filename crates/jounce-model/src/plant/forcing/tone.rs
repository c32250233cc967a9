//! Sinusoidal drives: response of the plant to each frequency without contact.

use crate::plant::diagonal::block_pair::exponential_integral_s;
use crate::plant::{Plant, PlantError, Port, dot};
use jounce_linalg::c64;

/// Largest number of cycles of the slowest drive in a common period.
const MAX_COMMON_CYCLES: usize = 100;

/// Largest deviation of a number of cycles from an integer.
const WHOLE_CYCLE_ERROR: f64 = 1e-9;

/// Sum of the sinusoids of all drives of one frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Tone {
    /// Angular frequency, rad/s.
    pub angular_frequency_rad_s: f64,
    /// Complex modal force `G` (N kg^-1/2 per mode): the modal force is `Re(G e^{i w t})`.
    pub force: Vec<c64>,
    /// Steady state `Y` in block coordinates: without contact `x = T Re(Y e^{i w t})`.
    pub steady: Vec<c64>,
}

impl Plant {
    /// Returns the common period of all drives, s: an integer number of cycles of each; `None` if
    /// the sum is not periodic within 100 cycles of the slowest.
    pub fn period_s(&self) -> Option<f64> {
        let slowest = self
            .tones
            .iter()
            .map(|tone| tone.angular_frequency_rad_s)
            .reduce(f64::min)?;
        if self.system.aperiodic().is_some() {
            return None;
        }
        let mut cycles = 1;
        for tone in &self.tones {
            // Least multiple of the cycles so far that is an integer for this tone too.
            let ratio = tone.angular_frequency_rad_s / slowest;
            let is_integer = |count: usize| {
                (ratio * count as f64 - (ratio * count as f64).round()).abs()
                    <= WHOLE_CYCLE_ERROR * ratio * count as f64
            };
            cycles = (1..=MAX_COMMON_CYCLES / cycles)
                .map(|times| times * cycles)
                .find(|count| is_integer(*count))?;
        }
        Some(cycles as f64 * std::f64::consts::TAU / slowest)
    }

    /// Returns the complex amplitude of an output row under each tone.
    pub fn steady_output(&self, row: &[f64]) -> Vec<c64> {
        self.tones
            .iter()
            .map(|tone| dot(row, &tone.steady))
            .collect()
    }

    /// Returns the steady state in block coordinates at a time.
    pub fn steady_at(&self, time_s: f64) -> Vec<f64> {
        let mut steady = vec![0.0; self.len()];
        for tone in &self.tones {
            let turn = c64::cis(tone.angular_frequency_rad_s * time_s);
            steady
                .iter_mut()
                .zip(&tone.steady)
                .for_each(|(s, y)| *s += (turn * y).re);
        }
        steady
    }

    /// Returns the integral of the steady state from a time over a length of time.
    pub fn steady_integral(&self, from_s: f64, length_s: f64) -> Vec<f64> {
        let mut sum = vec![0.0; self.len()];
        for tone in &self.tones {
            let rate = c64::new(0.0, tone.angular_frequency_rad_s);
            let turn = c64::cis(tone.angular_frequency_rad_s * from_s)
                * exponential_integral_s(rate, length_s);
            sum.iter_mut()
                .zip(&tone.steady)
                .for_each(|(s, y)| *s += (turn * y).re);
        }
        sum
    }

    /// Returns displacement (m) and velocity (m/s) of a port in the steady state at a time.
    pub fn driven(&self, port: &Port, time_s: f64) -> [f64; 2] {
        self.tones
            .iter()
            .zip(&port.steady_m)
            .fold([0.0; 2], |[displacement, speed], (tone, s)| {
                let phasor = s * c64::cis(tone.angular_frequency_rad_s * time_s);
                [
                    displacement + phasor.re,
                    speed - tone.angular_frequency_rad_s * phasor.im,
                ]
            })
    }

    pub(in crate::plant) fn make_tones(&self) -> Result<Vec<Tone>, PlantError> {
        let mut tones: Vec<Tone> = Vec::new();
        for drive in &self.system.drives {
            let w = std::f64::consts::TAU * drive.frequency_hz;
            // F sin(w t + a) = Re(-i F e^{i a} e^{i w t})
            let amplitude = c64::new(0.0, -drive.amplitude_n) * c64::cis(drive.phase_rad);
            let force = drive.shape.iter().map(|s| amplitude * s);
            match tones
                .iter_mut()
                .find(|tone| tone.angular_frequency_rad_s == w)
            {
                Some(tone) => tone
                    .force
                    .iter_mut()
                    .zip(force)
                    .for_each(|(sum, f)| *sum += f),
                None => tones.push(Tone {
                    angular_frequency_rad_s: w,
                    force: force.collect(),
                    steady: Vec::new(),
                }),
            }
        }
        for tone in &mut tones {
            tone.steady = self.steady_state(tone.angular_frequency_rad_s, &tone.force)?;
        }
        Ok(tones)
    }

    /// Returns `(i w I - A)^-1` of a complex modal force, in block coordinates.
    ///
    /// # Errors
    /// [`PlantError::UndampedResonance`] if an eigenvalue equals `i w` to roundoff.
    pub fn steady_state(
        &self,
        angular_frequency_rad_s: f64,
        modal_force: &[c64],
    ) -> Result<Vec<c64>, PlantError> {
        let s = c64::new(0.0, angular_frequency_rad_s);
        for value in self.diagonal.block.eigenvalues() {
            if (s - value).norm() <= 1e-12 * angular_frequency_rad_s.max(value.norm()) || s == value
            {
                return Err(PlantError::UndampedResonance {
                    frequency_hz: angular_frequency_rad_s / std::f64::consts::TAU,
                    mode_hz: value.norm() / std::f64::consts::TAU,
                });
            }
        }
        let (n, inverse) = (self.system.modes.len(), &self.diagonal.from_physical);
        let column: Vec<c64> = (0..self.len())
            .map(|i| {
                modal_force
                    .iter()
                    .enumerate()
                    .map(|(j, g)| *g * inverse[(i, n + j)])
                    .sum()
            })
            .collect();
        Ok(self.diagonal.block.resolve(s, &column))
    }
}
