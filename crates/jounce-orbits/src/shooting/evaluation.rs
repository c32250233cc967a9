//! Period integrated from one state.

use crate::bordered::block_equations::{BlockEquations, EnergyCoordinates};
use crate::orbit::multipliers::Eigenbasis;
use jounce_continuation::{Direction, Linearization, Metric, Position, ResidualReport, tangent};
use jounce_dynamics::{Kernel, Trajectory};
use jounce_linalg::Mat;
use std::sync::OnceLock;

/// Integrated period with its derivative.
#[derive(Debug)]
pub struct ShootingEvaluation {
    /// Harvester.
    pub kernel: Kernel,
    /// `u` at the start of each cycle, and at the end of the last.
    pub strobe_states: Vec<Vec<f64>>,
    /// `R`.
    pub(crate) residual: Vec<f64>,
    /// Derivative of the state after the period by the state at its start, at fixed conserved
    /// charges. In block coordinates, modes without contact are decoupled.
    pub block_map: Mat<f64>,
    /// `dR / dp`.
    pub(crate) by_parameter: Vec<f64>,
    /// `W`.
    pub(crate) scale: Vec<f64>,
    /// Result of [`Self::map`], computed at the first call.
    pub(crate) map: OnceLock<Mat<f64>>,
    /// Result of [`Self::eigenbasis`], computed at the first call.
    pub(crate) eigenbasis: OnceLock<Option<Eigenbasis>>,
    /// `R_u` factored with the first requested border.
    pub(crate) equations: OnceLock<BlockEquations>,
    /// Period, s.
    pub period_s: f64,
    /// True where a charge is conserved over the period: the orbit belongs to a family over this
    /// charge.
    pub keeps_charge: bool,
    /// Trajectories of the cycles.
    pub trajectories: Vec<Trajectory>,
    /// Number of contacts that began.
    pub contacts: u64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Largest magnitude of a contact force, N.
    pub max_contact_force_n: f64,
    /// Largest impact speed, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean power of each load and then of each rectified circuit, W.
    pub loads_w: Vec<f64>,
    /// Tolerance of the integration.
    pub(crate) tolerance: f64,
}

impl ShootingEvaluation {
    /// Returns `M = d u(n T) / d u(0)` at fixed conserved charges.
    pub fn map(&self) -> &Mat<f64> {
        self.map.get_or_init(|| {
            let diagonal = &self.kernel.plant.diagonal;
            let full_map = &diagonal.to_physical * &self.block_map * &diagonal.from_physical;
            Mat::from_fn(full_map.nrows(), full_map.ncols(), |i, j| {
                full_map[(i, j)] * self.scale[i] / self.scale[j]
            })
        })
    }

    /// Returns the multipliers with their eigenvectors; `None` where they do not converge.
    pub fn eigenbasis(&self) -> Option<&Eigenbasis> {
        self.eigenbasis
            .get_or_init(|| Eigenbasis::of(&self.block_map))
            .as_ref()
    }

    /// Returns the Newton correction to the curve of orbits, normal to it, and its length relative
    /// to the state; finite at a fold too.
    pub fn across(&self, parameter: f64, parameter_scale: f64) -> Option<(Direction, f64)> {
        let metric = Metric::at(
            &Position {
                unknown: self.strobe_states[0].clone(),
                parameter,
            },
            parameter_scale,
        );
        let up = Direction {
            unknown: vec![0.0; self.residual.len()],
            parameter: parameter_scale,
        };
        let right: Vec<f64> = self.residual.iter().map(|r| -r).collect();
        let along = tangent(self, &metric, &up)?;
        let (row, corner) = metric.row(&along);
        let (unknown, parameter) = self.bordered(&row, corner, &right, 0.0)?;
        let across = Direction { unknown, parameter };
        let length = metric.length(&across);
        Some((across, length))
    }

    /// Returns the length of a drive cycle, s.
    pub fn cycle_s(&self) -> f64 {
        self.period_s / self.trajectories.len() as f64
    }

    /// Returns the relative tolerance of the integration.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Returns the displacement of the port of a stop, m, at `samples` equally spaced times of the
    /// period.
    pub fn displacements_m(&self, stop: usize, samples: usize) -> Vec<f64> {
        let plant = &self.kernel.plant;
        let Some(port) = plant.ports.get(stop) else {
            return vec![0.0; samples];
        };
        let cycle_s = self.cycle_s();
        let times: Vec<f64> = (0..samples)
            .map(|k| self.period_s * k as f64 / samples as f64)
            .collect();
        let mut values = Vec::with_capacity(samples);
        for (cycle, trajectory) in self.trajectories.iter().enumerate() {
            let cycle_times_s: Vec<f64> = (times.iter())
                .filter(|time_s| (**time_s / cycle_s) as usize == cycle)
                .map(|time_s| time_s - cycle as f64 * cycle_s)
                .collect();
            let states = trajectory.at(&self.kernel, &cycle_times_s);
            values.extend(states.iter().map(|at| at.displacement_m(plant, port)));
        }
        values
    }

    fn coordinates(&self) -> EnergyCoordinates<'_> {
        EnergyCoordinates {
            diagonal: &self.kernel.plant.diagonal,
            scale: &self.scale,
        }
    }
}

impl Linearization for ShootingEvaluation {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Reports the residual by mode and by electrical state.
    fn parts(&self) -> ResidualReport {
        let modes = self.kernel.plant.system.modes.len();
        let moving = (0..modes).map(|k| {
            (
                format!("mode {}", k + 1),
                self.residual[k].hypot(self.residual[modes + k]),
            )
        });
        let charged = self.residual[2 * modes..]
            .iter()
            .enumerate()
            .map(|(k, voltage)| (format!("electrical state {}", k + 1), voltage.abs()));
        ResidualReport {
            unit: "sqrt(J)",
            sizes: moving.chain(charged).collect(),
        }
    }

    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let equations = self.equations.get_or_init(|| {
            BlockEquations::new(
                &self.block_map,
                &self.by_parameter,
                (row, corner),
                self.coordinates(),
            )
        });
        equations.solve((row, corner), (right, last), self.coordinates())
    }
}
