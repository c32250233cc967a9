//! Derivative of a plant by one parameter, in the block coordinates of the plant.
//!
//! The coordinates stay those of the plant, so that no derivative of an eigenvector is needed: with
//! the parameter `p`
//!
//! ```text
//! y' = (A + p dA) y + ...,   dA = T^-1 A_p T,   A_p = dA_physical / dp,
//! Y_p = (i w I - A)^-1 (dA Y + T^-1 G_p - i w_p Y)
//! ```
//!
//! where `Y` is the steady state under a tone with the complex force `G`. A change of the drive
//! frequency is a change of the time scale: over a fixed fraction of the drive cycle all rates
//! change by the `stretch` of the period.
//!
//! Source: the implicit function theorem for the steady state; the rest is linear.

mod coefficients;

pub use coefficients::Coefficients;

use super::{Plant, PlantError, dot, product};
use crate::contact::Law;
use jounce_linalg::{Mat, c64};

/// Largest deviation of the changes of several frequencies from a common ratio.
const COMMON_STRETCH_ERROR: f64 = 1e-9;

/// Derivative of a plant by a parameter, per unit of the parameter.
#[derive(Debug, Clone)]
pub struct PlantDerivative {
    /// Change of `A`, 1/s, without the stretch.
    pub rates: Mat<f64>,
    /// Change of the rate of the state under constant drives, without the stretch.
    pub constant: Vec<f64>,
    /// Relative change of the period.
    pub stretch: f64,
    /// Change of each tone.
    pub tones: Vec<ToneDerivative>,
    /// Change of each stop.
    pub ports: Vec<PortDerivative>,
    /// Change of each load that a patch feeds.
    pub loads: Vec<LoadDerivative>,
    /// Change of the rows of the charges of open nodes, physical coordinates.
    pub charges: Vec<Vec<f64>>,
}

/// Change of a tone.
#[derive(Debug, Clone)]
pub struct ToneDerivative {
    /// Steady state.
    pub steady: Vec<c64>,
    /// Angular frequency, rad/s.
    pub angular_frequency_rad_s: f64,
}

/// Change of the port of a stop.
#[derive(Debug, Clone)]
pub struct PortDerivative {
    /// Row of the displacement towards the stop.
    pub displacement: Vec<f64>,
    /// Row of the velocity.
    pub velocity: Vec<f64>,
    /// Column of a unit force.
    pub force: Vec<f64>,
    /// Complex displacement of each tone, m.
    pub steady_m: Vec<c64>,
    /// Gap, m.
    pub gap_m: f64,
    /// Impulse of a rigid stop per speed, kg.
    pub impulse_kg: f64,
    /// Laws at changed values of the parameter, with their weights in the derivative of the force;
    /// empty where the law does not change.
    pub laws: Vec<(f64, Law)>,
}

/// A load and its change: its power is `factor_per_ohm (row . x)^2`.
#[derive(Debug, Clone)]
pub struct LoadDerivative {
    /// Change of the row.
    pub row: Vec<f64>,
    /// Change of the factor.
    pub factor_per_ohm: f64,
}

impl PlantDerivative {
    /// Converts the derivative of the coefficients of a system to the block coordinates of its
    /// plant.
    ///
    /// # Errors
    /// [`PlantError::NoDerivative`] where the drives keep no common period.
    pub fn of(plant: &Plant, change: &Coefficients) -> Result<Self, PlantError> {
        let diagonal = &plant.diagonal;
        let rates = &diagonal.from_physical * &change.rates * &diagonal.to_physical;
        let tones = tones(plant, change, &rates)?;
        let stretches: Vec<f64> = (plant.tones.iter().zip(&tones))
            .map(|(tone, by)| -by.angular_frequency_rad_s / tone.angular_frequency_rad_s)
            .collect();
        let stretch = stretches.first().copied().unwrap_or(0.0);
        let is_common = |one: &f64| (one - stretch).abs() <= COMMON_STRETCH_ERROR * stretch.abs();
        if !stretches.iter().all(is_common) {
            return Err(PlantError::NoDerivative {
                part: "one of several frequencies".to_owned(),
            });
        }
        let constant = change
            .constants
            .iter()
            .fold(vec![0.0; plant.len()], |sum, force| {
                let column = plant.force_column(force);
                sum.iter().zip(column).map(|(sum, b)| sum + b).collect()
            });
        let port = |index: usize| port(plant, change, &tones, index);
        let row = |row: &[f64]| plant.row(row, 0);
        Ok(Self {
            constant,
            stretch,
            ports: (0..change.stops.len()).map(port).collect(),
            loads: (change.loads.iter())
                .map(|load| LoadDerivative {
                    row: row(&load.row),
                    factor_per_ohm: load.factor_per_ohm,
                })
                .collect(),
            charges: change.charges.clone(),
            rates,
            tones,
        })
    }

    /// Returns the derivative of the steady state at a fixed phase of the drives, at a time.
    pub fn steady_at(&self, plant: &Plant, time_s: f64) -> Vec<f64> {
        let mut sum = vec![0.0; plant.len()];
        for (tone, by) in plant.tones.iter().zip(&self.tones) {
            let turn = c64::cis(tone.angular_frequency_rad_s * time_s);
            let pairs = sum.iter_mut().zip(&by.steady);
            pairs.for_each(|(sum, steady)| *sum += (turn * steady).re);
        }
        sum
    }
}

/// Returns the derivative of each tone; the drives of a tone must keep one frequency.
fn tones(
    plant: &Plant,
    change: &Coefficients,
    rates: &Mat<f64>,
) -> Result<Vec<ToneDerivative>, PlantError> {
    let n = plant.system.modes.len();
    let of = |tone: &super::Tone| {
        let w = tone.angular_frequency_rad_s;
        let drives = || {
            let all = plant.system.drives.iter().zip(&change.drives);
            all.filter(|(drive, _)| std::f64::consts::TAU * drive.frequency_hz == w)
                .map(|(_, by)| by)
        };
        let frequency = drives().next().map_or(0.0, |by| by.angular_frequency_rad_s);
        let scale = frequency.abs().max(f64::MIN_POSITIVE);
        if drives()
            .any(|by| (by.angular_frequency_rad_s - frequency).abs() > COMMON_STRETCH_ERROR * scale)
        {
            return Err(PlantError::NoDerivative {
                part: "one of several frequencies".to_owned(),
            });
        }
        let mut force = vec![c64::new(0.0, 0.0); n];
        for by in drives() {
            force
                .iter_mut()
                .zip(&by.force)
                .for_each(|(sum, g)| *sum += g);
        }
        let parts = [|g: &c64| g.re, |g: &c64| g.im]
            .map(|part| plant.force_column(&force.iter().map(part).collect::<Vec<f64>>()));
        let [re, im] = [|y: &c64| y.re, |y: &c64| y.im]
            .map(|part| product(rates, &tone.steady.iter().map(part).collect::<Vec<f64>>()));
        let right: Vec<c64> = (0..plant.len())
            .map(|i| {
                let forced = c64::new(parts[0][i] + re[i], parts[1][i] + im[i]);
                forced - tone.steady[i] * c64::new(0.0, frequency)
            })
            .collect();
        Ok(ToneDerivative {
            steady: plant.diagonal.block.resolve(c64::new(0.0, w), &right),
            angular_frequency_rad_s: frequency,
        })
    };
    plant.tones.iter().map(of).collect()
}

fn port(
    plant: &Plant,
    change: &Coefficients,
    tones: &[ToneDerivative],
    index: usize,
) -> PortDerivative {
    let (stop, port) = (&change.stops[index], &plant.ports[index]);
    let displacement = plant.displacement_row(&stop.shape);
    let reaction: Vec<f64> = stop.shape.iter().map(|s| -s).collect();
    let steady = |(tone, by): (&super::Tone, &ToneDerivative)| {
        let drives = plant.system.drives.iter().zip(&change.drives);
        let approach: c64 = drives
            .filter(|(drive, _)| {
                std::f64::consts::TAU * drive.frequency_hz == tone.angular_frequency_rad_s
            })
            .map(|(_, by)| by.approach_m[index])
            .sum();
        dot(&port.displacement, &by.steady) + dot(&displacement, &tone.steady) + approach
    };
    PortDerivative {
        velocity: plant.velocity_row(&stop.shape),
        force: plant.force_column(&reaction),
        steady_m: plant.tones.iter().zip(tones).map(steady).collect(),
        gap_m: stop.gap_m,
        impulse_kg: stop.impulse_kg,
        laws: Vec::new(),
        displacement,
    }
}
