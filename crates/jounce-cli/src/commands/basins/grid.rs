//! `--grid SIDE=FROM:TO:Nx`: sides of a plane or box of starts, and their axes in the picture.

use crate::failure::Failure;
use jounce_core::analysis::{Grid, GridAxis, GridError, SectionPoint};
use jounce_core::picture::Axis;

/// Reads the sides; `None` without any.
pub fn read(texts: &[String], stops: usize) -> Result<Option<Grid>, Failure> {
    if texts.is_empty() {
        return Ok(None);
    }
    Grid::read(texts, stops)
        .map(Some)
        .map_err(|error| match error {
            GridError::NoStop => Failure::Input(format!("--grid: {error}")),
            GridError::TooMany => Failure::usage(format!("--grid: {error}")),
            GridError::Side { .. } | GridError::Twice { .. } => {
                Failure::usage(format!("--grid {error}"))
            }
        })
}

/// Returns the axis in the picture.
pub fn axis(axis: GridAxis) -> Axis {
    match axis {
        GridAxis::Displacement => Axis::linear("Displacement towards the stop", "m"),
        GridAxis::Velocity => Axis::linear("Velocity", "m/s"),
        GridAxis::Voltage => Axis::linear("Voltage", "V"),
    }
}

/// Returns the coordinate of a start on an axis.
pub fn value(axis: GridAxis, point: &SectionPoint) -> f64 {
    match axis {
        GridAxis::Displacement => point.displacement_m,
        GridAxis::Velocity => point.velocity_m_per_s,
        GridAxis::Voltage => point.voltage_v,
    }
}
