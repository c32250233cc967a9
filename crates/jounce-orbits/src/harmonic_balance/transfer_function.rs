//! Compliance of the plant between its ports, at the harmonics of an orbit.
//!
//! ```text
//! d(t) = Re(S e^{i w t}) + sum_n G(i n w / p) f_n e^{i n w t / p},   G(s) = c (s I - A)^-1 b
//! ```
//!
//! `d` is the displacement of a port (m), `f` the contact force at one (N), `p` the drive cycles in
//! the period. The diagonal form makes `G` exact at a cost proportional to the number of modes
//! times the number of harmonics.

use jounce_linalg::c64;
use jounce_model::plant::Plant;
use std::f64::consts::SQRT_2;

/// `G = row (s I - A)^-1 b` at the harmonics of an orbit, and its derivative by `s`.
#[derive(Debug, Clone)]
pub struct TransferFunction {
    /// `G` at `s = i n w / p`, `n = 0..=harmonics`.
    pub values: Vec<c64>,
    /// `dG / ds` there.
    pub slopes: Vec<c64>,
}

impl TransferFunction {
    /// Computes `G` from a force on a `column` to an output `row`; `step_rad_s` is `w / p`. Free
    /// states without restoring force are excluded: see [`moves_without_end`].
    pub fn new(
        plant: &Plant,
        row: &[f64],
        column: &[f64],
        step_rad_s: f64,
        harmonics: usize,
    ) -> Self {
        let none = vec![c64::new(0.0, 0.0); harmonics + 1];
        let mut transfer = Self {
            values: none.clone(),
            slopes: none,
        };
        let block = &plant.diagonal.block;
        let free = block.free();
        for (pair, ((c, u), free)) in block.pairs.iter().zip(
            row.chunks_exact(2)
                .zip(column.chunks_exact(2))
                .zip(free.chunks_exact(2)),
        ) {
            if free[0] {
                continue;
            }
            let [a, b, d, e] = pair.matrix();
            let first = c[0] * u[0] + c[1] * u[1];
            let rest = c[0] * (b * u[1] - e * u[0]) + c[1] * (d * u[0] - a * u[1]);
            transfer.add(step_rad_s, [first, rest], [1.0, -a - e, a * e - b * d]);
        }
        let paired = 2 * block.pairs.len();
        for (rate, ((c, u), free)) in block.reals.iter().zip(
            row[paired..]
                .iter()
                .zip(&column[paired..])
                .zip(&free[paired..]),
        ) {
            if *free {
                continue;
            }
            transfer.add(step_rad_s, [0.0, c * u], [0.0, 1.0, -rate]);
        }
        transfer
    }

    /// Adds `(p s + q) / (a s^2 + b s + c)`.
    fn add(&mut self, step_rad_s: f64, [p, q]: [f64; 2], [a, b, c]: [f64; 3]) {
        for (n, (value, slope)) in self.values.iter_mut().zip(&mut self.slopes).enumerate() {
            let w = n as f64 * step_rad_s;
            let inverse = c64::new(c - a * w * w, b * w).inv();
            let term = c64::new(q, p * w) * inverse;
            *value += term;
            *slope += (c64::new(p, 0.0) - term * c64::new(b, 2.0 * a * w)) * inverse;
        }
    }
}

/// Fraction of a free state in the motion of a port above which the port moves it: the charge of an
/// open patch has roundoff.
const FREE_STATE_SHARE: f64 = 1e-9;

/// True where a constant force at a stop moves a free body without limit: `G` is infinite at
/// frequency zero. A free state that no stop reaches, such as the charge of an open patch, has no
/// part in `G`.
pub fn moves_without_end(plant: &Plant) -> bool {
    let free = plant.diagonal.block.free();
    let ports = &plant.ports[..plant.system.stops.len()];
    // Either state of a pair may be the one that the force acts on.
    let share = |row: &[f64], column: &[f64], i: usize| row[i].abs() * column[i ^ 1].abs();
    ports
        .iter()
        .flat_map(|a| ports.iter().map(move |b| (&a.displacement, &b.force)))
        .any(|(row, column)| {
            let paired = 2 * plant.diagonal.block.pairs.len();
            let of = |i: usize| {
                (row[i] * column[i]).abs()
                    + if i < paired {
                        share(row, column, i)
                    } else {
                        0.0
                    }
            };
            let total: f64 = (0..row.len()).map(of).sum();
            (0..row.len())
                .filter(|i| free[*i])
                .any(|i| of(i) > FREE_STATE_SHARE * total)
        })
}

/// Adds a harmonic of the drive, complex displacement of the port in m, to the harmonics of a
/// period of `cycles` drive cycles.
pub fn add_tone(displacement_m: c64, cycles: u32, harmonics: &mut [f64]) {
    let n = cycles as usize;
    harmonics[2 * n - 1] += displacement_m.re / SQRT_2;
    harmonics[2 * n] -= displacement_m.im / SQRT_2;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `1 / (s^2 + 3 s + 5)` and its derivative at `s = 2 i`.
    #[test]
    fn a_quotient_and_its_slope() {
        let none = vec![c64::new(0.0, 0.0); 2];
        let mut transfer = TransferFunction {
            values: none.clone(),
            slopes: none,
        };
        transfer.add(2.0, [0.0, 1.0], [1.0, 3.0, 5.0]);
        let below = c64::new(1.0, 6.0);
        assert!((transfer.values[1] - 1.0 / below).norm() < 1e-16);
        assert!((transfer.slopes[1] + c64::new(3.0, 4.0) / (below * below)).norm() < 1e-16);
    }
}
