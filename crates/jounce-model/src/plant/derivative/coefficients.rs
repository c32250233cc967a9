//! Numbers in the equations of a system, in physical coordinates, so that their differences can be
//! taken.

use crate::contact::Law;
use crate::drive::Wave;
use crate::plant::diagonal::coupled_rates;
use crate::plant::{Across, Drive, Electrical, ElectricalNode, PlantError, Signal, Stop, System};
use jounce_linalg::{Mat, c64, norm};
use std::f64::consts::TAU;

/// Size of a difference, relative to that of its terms, below which it is roundoff.
const ROUNDOFF: f64 = 1e-9;

/// Numbers in the equations of a system.
#[derive(Debug, Clone)]
pub struct Coefficients {
    /// `A` of `x' = A x`, `x = (q, q', V, i)`.
    pub rates: Mat<f64>,
    /// Stops.
    pub stops: Vec<StopCoefficients>,
    /// Sinusoidal drives, in the order of `system.drives`.
    pub drives: Vec<DriveCoefficients>,
    /// Modal force of each constant drive, in the order of the constant `system.signals`.
    pub constants: Vec<Vec<f64>>,
    /// Loads that a patch feeds.
    pub loads: Vec<LoadCoefficients>,
    /// Rows of the charges of open nodes, which no motion changes, `C V + theta . q`.
    pub charges: Vec<Vec<f64>>,
}

/// Numbers of a stop.
#[derive(Debug, Clone)]
pub struct StopCoefficients {
    /// Displacement towards the stop per unit modal coordinate, kg^-1/2.
    pub shape: Vec<f64>,
    /// Gap, m.
    pub gap_m: f64,
    /// Impulse of a rigid stop per speed, kg; 0 for other laws.
    pub impulse_kg: f64,
}

/// Numbers of a sinusoidal drive.
#[derive(Debug, Clone)]
pub struct DriveCoefficients {
    /// Complex modal force, N kg^-1/2 per mode.
    pub force: Vec<c64>,
    /// Angular frequency, rad/s.
    pub angular_frequency_rad_s: f64,
    /// Complex displacement towards each stop due to the motion of its base, m.
    pub approach_m: Vec<c64>,
}

/// Numbers of a load: its power is `factor_per_ohm (row . x)^2`.
#[derive(Debug, Clone)]
pub struct LoadCoefficients {
    /// Row of the physical state.
    pub row: Vec<f64>,
    /// Factor, 1/ohm for a voltage.
    pub factor_per_ohm: f64,
}

impl Coefficients {
    /// Reads the numbers of a system.
    ///
    /// # Errors
    /// [`PlantError::NoDerivative`] for a system whose equations switch or whose drives are not
    /// periodic.
    pub fn of(system: &System) -> Result<Self, PlantError> {
        if !system.bridges.is_empty() {
            return Err(PlantError::NoDerivative {
                part: "a rectified circuit".to_owned(),
            });
        }
        if let Some(part) = system.aperiodic() {
            return Err(PlantError::NoDerivative { part });
        }
        let electrical = Electrical::of(system);
        let constant = |signal: &Signal| match signal.wave {
            Wave::Constant(size) => Some(signal.shape.iter().map(|s| s * size).collect()),
            _ => None,
        };
        Ok(Self {
            rates: coupled_rates(system, &electrical),
            stops: system.stops.iter().map(of_stop).collect(),
            drives: system
                .drives
                .iter()
                .map(|drive| of_drive(drive, system))
                .collect(),
            constants: system.signals.iter().filter_map(constant).collect(),
            loads: loads(system, &electrical),
            charges: charges(system, &electrical),
        })
    }

    /// Returns a linear combination of the numbers of systems of the same form.
    ///
    /// # Errors
    /// [`PlantError::NoDerivative`] where the systems differ in their form.
    pub fn combined(parts: &[(f64, Self)]) -> Result<Self, PlantError> {
        let mut sum = parts[0].1.clone();
        sum.numbers().into_iter().for_each(|number| *number = 0.0);
        for (weight, part) in parts {
            let mut part = part.clone();
            let (into, from) = (sum.numbers(), part.numbers());
            if into.len() != from.len() {
                return Err(PlantError::NoDerivative {
                    part: "a change of the number of modes, circuits or stops".to_owned(),
                });
            }
            for (number, by) in into.into_iter().zip(from) {
                *number += weight * *by;
            }
        }
        Ok(sum)
    }

    /// Returns the largest distance of the matrices, and of the shapes, of two sets of numbers,
    /// relative to their size or, where that is roundoff, to that of `scale`.
    pub fn distance(&self, other: &Self, scale: &Self) -> f64 {
        let of = |a: &[f64], b: &[f64], scale: &[f64]| {
            let apart: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
            let size = norm(b).max(ROUNDOFF * norm(scale));
            if size > 0.0 { norm(&apart) / size } else { 0.0 }
        };
        let stops = self.stops.iter().zip(&other.stops).zip(&scale.stops);
        let rates = [self, other, scale].map(|one| one.rates.as_slice());
        stops
            .map(|((a, b), scale)| of(&a.shape, &b.shape, &scale.shape))
            .fold(of(rates[0], rates[1], rates[2]), f64::max)
    }

    /// Returns all numbers in a fixed order.
    fn numbers(&mut self) -> Vec<&mut f64> {
        let mut all: Vec<&mut f64> = self.rates.iter_mut().collect();
        for stop in &mut self.stops {
            all.extend(&mut stop.shape);
            all.extend([&mut stop.gap_m, &mut stop.impulse_kg]);
        }
        for drive in &mut self.drives {
            let parts = drive.force.iter_mut().chain(&mut drive.approach_m);
            all.extend(parts.flat_map(|part| [&mut part.re, &mut part.im]));
            all.push(&mut drive.angular_frequency_rad_s);
        }
        all.extend(self.constants.iter_mut().flatten());
        for load in &mut self.loads {
            all.extend(&mut load.row);
            all.push(&mut load.factor_per_ohm);
        }
        all.extend(self.charges.iter_mut().flatten());
        all
    }
}

fn of_stop(stop: &Stop) -> StopCoefficients {
    let mobility_per_kg: f64 = stop.shape.iter().map(|s| s * s).sum();
    StopCoefficients {
        shape: stop.shape.clone(),
        gap_m: stop.gap_m,
        impulse_kg: match stop.law {
            Law::Rigid(law) => (1.0 + law.restitution) / mobility_per_kg,
            _ => 0.0,
        },
    }
}

fn of_drive(drive: &Drive, system: &System) -> DriveCoefficients {
    // F sin(w t + a) = Re(-i F e^{i a} e^{i w t})
    let w = TAU * drive.frequency_hz;
    let amplitude = c64::new(0.0, -drive.amplitude_n) * c64::cis(drive.phase_rad);
    // X sin(w t + a) = Re(-i X e^{i a} e^{i w t}), X = -acceleration / w^2
    let approach = |stop: &Stop| -amplitude * stop.share_of(drive.base.as_ref()) / (w * w);
    DriveCoefficients {
        force: drive.shape.iter().map(|s| amplitude * *s).collect(),
        angular_frequency_rad_s: w,
        approach_m: system.stops.iter().map(approach).collect(),
    }
}

fn loads(system: &System, electrical: &Electrical) -> Vec<LoadCoefficients> {
    let first = 2 * system.modes.len();
    let size = first + electrical.len();
    let pairs = system.loads.iter().zip(&electrical.load);
    pairs
        .filter_map(|(load, across)| {
            let (state, factor) = match (*across)? {
                Across::Node(node) => (first + node, 1.0),
                Across::Inductor(inductor, resistance_ohm) => {
                    (first + electrical.nodes.len() + inductor, resistance_ohm)
                }
            };
            let mut row = vec![0.0; size];
            row[state] = factor;
            Some(LoadCoefficients {
                row,
                factor_per_ohm: 1.0 / load.resistance_ohm,
            })
        })
        .collect()
}

fn charges(system: &System, electrical: &Electrical) -> Vec<Vec<f64>> {
    let first = 2 * system.modes.len();
    let row = |(index, node): (usize, &ElectricalNode)| {
        let mut row = node.coupling_n_per_v.clone();
        row.resize(first + electrical.len(), 0.0);
        row[first + index] = node.capacitance_f;
        row
    };
    let nodes = electrical.nodes.iter().enumerate();
    let open = nodes.filter(|(index, _)| electrical.is_open(*index));
    open.map(row).collect()
}
