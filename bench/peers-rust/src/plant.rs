//! The modal plant, read from the parameter file that `run.py` writes, and its right-hand side.
//!
//! State: `M` modal displacements, `M` modal velocities, the voltage (V), the energy in the resistor (J).

use std::fs;

/// A plant of `M` modes in SI units; rows that are used together stand side by side.
pub struct Plant<const M: usize> {
    pub stiffness: [f64; M],
    pub damping: [f64; M],
    pub tip: [f64; M],
    pub table: [f64; M],
    pub coupling: [f64; M],
    pub capacitance_f: f64,
    pub resistance_ohm: f64,
    pub gap_m: f64,
    pub contact: f64,
    pub amplitude_n: f64,
    pub drive_rad_s: f64,
    pub duration_s: f64,
    pub average_over_s: f64,
}

impl<const M: usize> Plant<M> {
    /// Reads a parameter file: a name and its numbers on each line.
    pub fn read(path: &str) -> Result<Self, String> {
        let text = fs::read_to_string(path).map_err(|e| format!("cannot read {path}: {e}"))?;
        let row = |name: &str| row(&text, name);
        let modal = |name: &str| {
            row(name)?
                .try_into()
                .map_err(|_| format!("{name} needs {M} numbers"))
        };
        let single = |name: &str| {
            row(name)?
                .first()
                .copied()
                .ok_or(format!("{name} is empty"))
        };
        let (frequency_hz, ratio): ([f64; M], [f64; M]) =
            (modal("frequency_hz")?, modal("damping_ratio")?);
        let omega = frequency_hz.map(|f| std::f64::consts::TAU * f);
        Ok(Self {
            stiffness: omega.map(|w| w * w),
            damping: std::array::from_fn(|i| 2.0 * ratio[i] * omega[i]),
            tip: modal("tip")?,
            table: modal("table")?,
            coupling: modal("coupling_n_per_v")?,
            capacitance_f: single("capacitance_f")?,
            resistance_ohm: single("resistance_ohm")?,
            gap_m: single("gap_m")?,
            contact: single("contact_n_per_m15")?,
            amplitude_n: single("amplitude_n")?,
            drive_rad_s: std::f64::consts::TAU * single("frequency_drive_hz")?,
            duration_s: single("duration_s")?,
            average_over_s: single("average_over_s")?,
        })
    }

    /// `dy/dt` at time `t` (s).
    #[inline]
    pub fn rate(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        let (q, v, voltage) = (&y[..M], &y[M..2 * M], y[2 * M]);
        let depth = (dot::<M>(&self.tip, q) - self.gap_m).max(0.0);
        self.rate_under(
            self.amplitude_n * (self.drive_rad_s * t).sin(),
            -self.contact * depth * depth.sqrt(),
            y,
            dy,
        );
        dy[..M].copy_from_slice(v);
        dy[2 * M + 1] = voltage * voltage / self.resistance_ohm;
    }

    /// The Jacobian of `rate` at `y` times `x`.
    pub fn rate_slope(&self, y: &[f64], x: &[f64], dy: &mut [f64]) {
        let depth = (dot::<M>(&self.tip, &y[..M]) - self.gap_m).max(0.0);
        let push = -1.5 * self.contact * depth.sqrt() * dot::<M>(&self.tip, &x[..M]);
        self.rate_under(0.0, push, x, dy);
        dy[..M].copy_from_slice(&x[M..2 * M]);
        dy[2 * M + 1] = 2.0 * y[2 * M] * x[2 * M] / self.resistance_ohm;
    }

    #[inline]
    fn rate_under(&self, drive_n: f64, contact_n: f64, y: &[f64], dy: &mut [f64]) {
        let (q, v, voltage) = (&y[..M], &y[M..2 * M], y[2 * M]);
        for i in 0..M {
            dy[M + i] =
                self.table[i] * drive_n + self.tip[i] * contact_n + self.coupling[i] * voltage
                    - self.stiffness[i] * q[i]
                    - self.damping[i] * v[i];
        }
        dy[2 * M] =
            -(voltage / self.resistance_ohm + dot::<M>(&self.coupling, v)) / self.capacitance_f;
    }
}

/// Four running sums, so that the compiler may use vectors.
#[inline]
fn dot<const M: usize>(a: &[f64; M], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    for i in 0..M {
        sums[i % 4] += a[i] * b[i];
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3])
}

fn row(text: &str, name: &str) -> Result<Vec<f64>, String> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix(' '))
        .ok_or(format!("{name} is missing"))?;
    line.split_whitespace()
        .map(|word| word.parse().map_err(|e| format!("{name}: '{word}': {e}")))
        .collect()
}

/// The number of modes in a parameter file.
pub fn modes(path: &str) -> Result<usize, String> {
    let text = fs::read_to_string(path).map_err(|e| format!("cannot read {path}: {e}"))?;
    Ok(row(&text, "frequency_hz")?.len())
}
