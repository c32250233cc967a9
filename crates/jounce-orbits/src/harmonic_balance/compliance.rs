//! Compliance between the ports: displacements under the contact forces.
//!
//! ```text
//! d^a_n = sum_b G^ab_n f^b_n
//! ```
//!
//! `a` and `b` number the stops. The harmonics are ordered port by port.

use super::compliance_table::ComplianceTable;
use super::fourier_grid::FourierGrid;
use super::motion::{complex, real};
use super::transfer_function::TransferFunction;
use jounce_linalg::c64;
use jounce_model::plant::Plant;

/// `G` of every pair of ports.
#[derive(Debug)]
pub struct PortCompliance {
    /// Number of ports; without a stop, one port that does not move.
    count: usize,
    harmonics: usize,
    /// Transfer functions row by row: the displacement of `a` under the force of `b`.
    transfers: Vec<TransferFunction>,
}

impl PortCompliance {
    /// Computes the compliance up to a harmonic of the period; `step_rad_s` is `w / p`.
    pub fn new(plant: &Plant, step_rad_s: f64, harmonics: usize) -> Self {
        let stops = plant.system.stops.len();
        let ports = &plant.ports[..stops];
        let from = |row| {
            move |b: &jounce_model::plant::Port| {
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

    /// Returns the harmonics of the displacements under given harmonics of the forces.
    pub fn apply(&self, forces: &[Vec<c64>]) -> Vec<f64> {
        self.summed(forces, |transfer, n| transfer.values[n])
    }

    /// Returns the change of the displacements where the frequency `w / p` changes at a rate
    /// (rad/s) and the harmonics of the forces are fixed.
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
        let mut derivative = Vec::with_capacity(self.count * (2 * self.harmonics + 1));
        for a in 0..self.count {
            let mut sum = vec![c64::new(0.0, 0.0); self.harmonics + 1];
            for (b, force) in forces.iter().enumerate() {
                let transfer = self.transfer(a, b);
                sum.iter_mut()
                    .zip(force)
                    .enumerate()
                    .for_each(|(n, (sum, f))| *sum += factor(transfer, n) * f);
            }
            derivative.extend(real(&sum));
        }
        derivative
    }

    /// Applies the transpose of [`Self::apply`]: the `c_n` that a row over all displacements gives
    /// at the port of each force.
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

    /// Returns the tables of the responses, row by row.
    pub fn responses(&self, grid: &FourierGrid) -> Vec<ComplianceTable> {
        self.transfers
            .iter()
            .map(|transfer| ComplianceTable::new(&transfer.values, grid))
            .collect()
    }

    /// Returns the number of real harmonics of one port.
    pub fn size(&self) -> usize {
        2 * self.harmonics + 1
    }

    /// Returns the highest harmonic.
    pub fn harmonics(&self) -> usize {
        self.harmonics
    }

    fn transfer(&self, a: usize, b: usize) -> &TransferFunction {
        &self.transfers[a * self.count + b]
    }
}
