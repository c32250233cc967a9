//! Powers that are sums of squares, in block coordinates: the part independent of the drives.

use super::lyapunov::{LyapunovSide, lyapunov};
use crate::plant::{Plant, PlantError};
use jounce_linalg::{Mat, c64};
use std::sync::Arc;

/// A power `y^T Q y`, W.
#[derive(Debug, PartialEq)]
pub struct Quadratic {
    /// `Q`.
    pub power: Mat<f64>,
    /// `P` of `A^T P + P A = -Q`: `y^T P y` is the energy, J, of the power in free decay from `y`.
    pub gramian: Mat<f64>,
}

/// Quadratic forms of all [`crate::plant::Meters`].
#[derive(Debug)]
pub struct Quadratics {
    /// Energy of each load, then of each of [`Plant::bridge_outputs`] and of
    /// [`Plant::leak_outputs`].
    pub loads: Vec<Arc<Quadratic>>,
    /// Energy of modal damping and friction.
    pub damping: Arc<Quadratic>,
}

/// One squared output with its weight.
type Square = (f64, Vec<f64>);

impl Quadratics {
    /// Returns the quadratic forms of a plant.
    ///
    /// # Errors
    /// [`PlantError::Undamped`] if an undamped mode carries power.
    pub fn of(plant: &Plant) -> Result<Self, PlantError> {
        let modes = &plant.system.modes;
        let loads = plant.system.loads.iter().enumerate().map(|(k, load)| {
            let square = (1.0 / load.resistance_ohm, plant.load_voltage_row(k));
            Quadratic::of(
                plant,
                &format!("the energy of load `{}`", load.name),
                &[square],
            )
        });
        let outputs = plant
            .bridge_outputs()
            .into_iter()
            .chain(plant.leak_outputs())
            .map(|output| {
                let name = match plant.system.bridges.get(output.bridge) {
                    Some(bridge) => format!("the energy of circuit `{}`", bridge.name),
                    None => "the leakage of a patch".to_owned(),
                };
                Quadratic::of(plant, &name, &[(output.conductance_per_ohm, output.row)])
            });
        let damped = |i: usize| {
            (
                2.0 * modes.damping_ratio[i] * modes.frequency_rad_s[i],
                plant.modal_velocity_row(i),
            )
        };
        let losses: Vec<Square> = ((0..modes.len())
            .map(damped)
            .filter(|(weight, _)| *weight > 0.0))
        .chain(
            plant
                .system
                .dashpots
                .iter()
                .map(|dashpot| (dashpot.n_s_m, plant.velocity_row(&dashpot.shape))),
        )
        .collect();
        Ok(Self {
            loads: loads.chain(outputs).collect::<Result<_, _>>()?,
            damping: Quadratic::of(plant, "the energy lost in damping", &losses)?,
        })
    }
}

impl Quadratic {
    fn of(plant: &Plant, name: &str, squares: &[Square]) -> Result<Arc<Self>, PlantError> {
        let n = plant.len();
        let power = Mat::from_fn(n, n, |i, j| {
            squares
                .iter()
                .map(|(weight, row)| weight * row[i] * row[j])
                .sum::<f64>()
        });
        let gramian = lyapunov(&plant.diagonal.block, LyapunovSide::Rows, |i, j| {
            power[(i, j)]
        });
        let gramian = gramian.map_err(|mode_hz| PlantError::Undamped {
            what: name.to_owned(),
            mode_hz,
        })?;
        Ok(Arc::new(Self { power, gramian }))
    }

    /// Returns `2 Q s`: the gradient of the power.
    pub fn slope(&self, state: &[c64]) -> Vec<c64> {
        let mut sum = vec![c64::new(0.0, 0.0); state.len()];
        for (j, s) in state.iter().enumerate() {
            sum.iter_mut()
                .zip(jounce_linalg::column(&self.power, j))
                .for_each(|(sum, q)| *sum += s * (2.0 * q));
        }
        sum
    }
}
