//! Plane or box of starts.
//!
//! ```text
//! displacement d   q_i = d (s_i / w_i^2) / sum s^2 / w^2    bent by a static force on the stop's point
//! velocity v       q_i' = v s_i / sum s^2                   struck at the stop's point
//! voltage V        of the first patch
//! ```
//!
//! `s` is the shape of the stop's port. Quantities without a side start at zero. A mode without
//! stiffness bends like one at the drive's frequency.

use jounce_model::plant::Plant;

/// Quantity of a side of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum GridAxis {
    /// Displacement towards the stop, m; with several stops, towards the first of the spec.
    Displacement,
    /// Velocity towards the stop, m/s.
    Velocity,
    /// Voltage of the first patch, V.
    Voltage,
}

/// Side of a grid: equal steps from one end to the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridSide {
    /// Quantity.
    pub axis: GridAxis,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values.
    pub count: usize,
}

/// Grid of starts: every combination of the values of its sides; the first side varies fastest.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Sides, each of a different quantity.
    pub sides: Vec<GridSide>,
}

impl GridSide {
    /// Returns value number `k`.
    pub fn value(&self, k: usize) -> f64 {
        if self.count < 2 {
            self.from
        } else {
            self.from + (self.to - self.from) * k as f64 / (self.count - 1) as f64
        }
    }
}

impl Grid {
    /// Number of starts.
    pub fn len(&self) -> usize {
        self.sides.iter().map(|side| side.count).product()
    }

    /// True for a grid without starts.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns start number `index` as a physical state `(q, q', V)`.
    pub fn start(&self, plant: &Plant, index: usize) -> Vec<f64> {
        let modes = &plant.system.modes;
        let n = modes.len();
        let drive = plant
            .tones
            .first()
            .map_or(1.0, |tone| tone.angular_frequency_rad_s);
        let shape: &[f64] = plant.system.stops.first().map_or(&[], |stop| &stop.shape);
        let soft = |i: usize| {
            if modes.frequency_rad_s[i] > 0.0 {
                modes.frequency_rad_s[i].powi(-2)
            } else {
                drive.powi(-2)
            }
        };
        let bends: f64 = shape.iter().enumerate().map(|(i, s)| s * s * soft(i)).sum();
        let square: f64 = shape.iter().map(|s| s * s).sum();
        let mut state = vec![0.0; plant.len()];
        let (mut rest, mut voltage_v) = (index, None);
        for side in &self.sides {
            let value = side.value(rest % side.count);
            rest /= side.count;
            match side.axis {
                GridAxis::Displacement => shape
                    .iter()
                    .enumerate()
                    .for_each(|(i, s)| state[i] = value * s * soft(i) / bends),
                GridAxis::Velocity => shape
                    .iter()
                    .enumerate()
                    .for_each(|(i, s)| state[n + i] = value * s / square),
                GridAxis::Voltage => voltage_v = Some(value),
            }
        }
        plant.keep_charges(&mut state);
        let first = state.iter_mut().skip(2 * n).take(1);
        first.zip(voltage_v).for_each(|(v, value)| *v = value);
        state
    }
}
