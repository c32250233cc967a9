//! Poincare section: motion at the stop at the start of a drive cycle.

use crate::{AnalysisError, Model, Parameter};
use jounce_model::plant::System;
use jounce_orbits::{Orbit, ParametricModel, Shooting};
use serde::{Deserialize, Serialize};

/// A point of the Poincare section.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SectionPoint {
    /// Displacement of the port towards the stop, m; with several stops, at the first of the spec.
    pub displacement_m: f64,
    /// Velocity of the port, m/s.
    pub velocity_m_s: f64,
    /// Voltage of the first patch, V.
    pub voltage_v: f64,
}

impl SectionPoint {
    /// Returns the section of a physical state `(q, q', V)`; without a stop, at the point of the
    /// first drive.
    pub fn of(system: &System, state: &[f64]) -> Self {
        let n = system.modes.len();
        let stop = system.stops.first().map(|stop| &stop.shape);
        let shape: &[f64] = stop
            .or(system.drives.first().map(|drive| &drive.shape))
            .map_or(&[], |shape| shape);
        let along = |part: &[f64]| shape.iter().zip(part).map(|(s, q)| s * q).sum();
        Self {
            displacement_m: along(&state[..n]),
            velocity_m_s: along(&state[n..2 * n]),
            voltage_v: state.get(2 * n).copied().unwrap_or_default(),
        }
    }

    /// Returns the section points of an orbit, one for each drive cycle of its period.
    ///
    /// # Errors
    /// A model cannot be built.
    pub fn of_orbit(
        base: &Model,
        parameter: &Parameter,
        value: f64,
        orbit: &Orbit,
    ) -> Result<Vec<Self>, AnalysisError> {
        let kernel = parameter.at(value)?.kernel;
        let shooting = Shooting::new(parameter, &base.kernel, orbit.period_cycles, 1e-9);
        let strobe_states = orbit
            .strobe_states
            .iter()
            .take(orbit.period_cycles as usize);
        Ok(strobe_states
            .map(|strobe_state| Self::of(&kernel.plant.system, &shooting.physical(strobe_state)))
            .collect())
    }
}
