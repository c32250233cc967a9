//! The plant between its ports: what every force moves.
//!
//! ```text
//! d^a_n = sum_b G^ab_n f^b_n
//! ```
//!
//! `a` and `b` number the stops. Harmonics of all ports stand one port after the other.

use super::compliance_table::ComplianceTable;
use super::motion::{complex, real};
use crate::orbit::compliance::{FourierGrid, TransferFunction};
use crate::plant::Plant;
use faer::c64;

/// `G` of every pair of ports.
#[derive(Debug)]
pub struct PortCompliance {
    /// Ports; one that nothing moves where there is no stop.
    count: usize,
    harmonics: usize,
    /// Row by row: the displacement of `a` under the force of `b`.
    transfers: Vec<TransferFunction>,
}

impl PortCompliance {
    /// Up to a harmonic of the period; `step_rad_s` is `w / p`.
    pub fn new(plant: &Plant, step_rad_s: f64, harmonics: usize) -> Self {
        let stops = plant.system.stops.len();
        let ports = &plant.ports[..stops];
        let from = |row| {
            move |b: &crate::plant::Port| {
                TransferFunction::new(plant, row, &b.force, step_rad_s, harmonics)
            }
        };
        let transfers = ports
            .iter()
            .flat_map(|a| ports.iter().map(from(&a.displacement)))
            .collect();
        Self {
            count: stops.max(1),
            harmonics,
            transfers,
        }
    }

    /// Harmonics of the displacements under those of the forces.
    pub fn apply(&self, forces: &[Vec<c64>]) -> Vec<f64> {
        self.summed(forces, |transfer, n| transfer.values[n])
    }

    /// Their change where the frequency `w / p` changes by a rate (rad/s), the harmonics of the forces being held.
    pub fn frequency_derivative(&self, forces: &[Vec<c64>], rate_rad_s: f64) -> Vec<f64> {
        self.summed(forces, |transfer, n| {
            transfer.slopes[n] * c64::new(0.0, n as f64 * rate_rad_s)
        })
    }

    fn summed(
        &self,
        forces: &[Vec<c64>],
        factor: impl Fn(&TransferFunction, usize) -> c64,
    ) -> Vec<f64> {
        let mut moved = Vec::with_capacity(self.count * (2 * self.harmonics + 1));
        for a in 0..self.count {
            let mut sum = vec![c64::new(0.0, 0.0); self.harmonics + 1];
            for (b, force) in forces.iter().enumerate() {
                let transfer = self.transfer(a, b);
                sum.iter_mut()
                    .zip(force)
                    .enumerate()
                    .for_each(|(n, (sum, f))| *sum += factor(transfer, n) * f);
            }
            moved.extend(real(&sum));
        }
        moved
    }

    /// The transpose of [`Self::apply`]: `c_n` that a row over all displacements gives at the port of each force.
    pub fn apply_adjoint(&self, row: &[f64]) -> Vec<Vec<c64>> {
        let rows: Vec<Vec<c64>> = row
            .chunks_exact(row.len() / self.count)
            .map(complex)
            .collect();
        let back = |b: usize| {
            let mut sum = vec![c64::new(0.0, 0.0); self.harmonics + 1];
            for (a, row) in rows.iter().enumerate() {
                let values = &self.transfer(a, b).values;
                sum.iter_mut()
                    .zip(row.iter().zip(values))
                    .for_each(|(sum, (r, g))| *sum += r * g.conj());
            }
            sum
        };
        (0..self.transfers.len() / self.count).map(back).collect()
    }

    /// Tables of the responses, row by row.
    pub fn responses(&self, grid: &FourierGrid) -> Vec<ComplianceTable> {
        self.transfers
            .iter()
            .map(|transfer| ComplianceTable::new(&transfer.values, grid))
            .collect()
    }

    /// Harmonics of one port, as real numbers.
    pub fn size(&self) -> usize {
        2 * self.harmonics + 1
    }

    /// Highest harmonic.
    pub fn harmonics(&self) -> usize {
        self.harmonics
    }

    fn transfer(&self, a: usize, b: usize) -> &TransferFunction {
        &self.transfers[a * self.count + b]
    }
}
