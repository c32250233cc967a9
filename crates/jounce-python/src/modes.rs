//! Modes and couplings.

use crate::arrays::{PythonDict, matrix};
use crate::failure::Failure;
use crate::spec::Spec;
use jounce_core::linear::couplings;
use jounce_core::structure::{modes_holding, shapes_along_beams};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::f64::consts::TAU;

/// Number of positions along each beam for the shapes.
const PLACES: usize = 201;

/// Computes natural frequencies, damping, couplings and shapes, with some masses fixed.
#[pyfunction]
pub fn modes<'py>(py: Python<'py>, spec: &Spec, hold: Vec<String>) -> PyResult<Bound<'py, PyDict>> {
    let solve = || {
        Ok::<_, Failure>((
            modes_holding(spec.spec(), &hold)?,
            shapes_along_beams(spec.spec(), &hold, PLACES)?,
        ))
    };
    let (modes, beams) = py
        .detach(solve)
        .map_err(|failure| failure.into_exception(py))?;
    let patches: Vec<&String> = modes.patch.keys().collect();
    let mut open_circuit = vec![vec![f64::NAN; modes.len()]; patches.len()];
    let mut squared = open_circuit.clone();
    for coupling in couplings(&modes) {
        let Some(patch) = patches.iter().position(|name| **name == coupling.patch) else {
            continue;
        };
        open_circuit[patch][coupling.mode] = coupling.open_circuit_hz;
        squared[patch][coupling.mode] = coupling.coupling_squared;
    }
    let shape_dict = PyDict::new(py);
    for (name, beam) in &beams {
        let rows: Vec<Vec<f64>> = (0..modes.len())
            .filter_map(|mode| beam.mode(mode))
            .collect();
        shape_dict.set_item(
            name,
            (
                numpy::PyArray1::from_slice(py, &beam.place_m),
                matrix(py, &rows, beam.place_m.len())?,
            ),
        )?;
    }
    let dict = PythonDict::new(py)
        .each("frequency_hz", &modes.frequency_rad_s, |w| w / TAU)?
        .with("point", modes.shape.keys().collect::<Vec<_>>())?
        .rows(
            "shape",
            &modes.shape.values().cloned().collect::<Vec<_>>(),
            modes.len(),
        )?
        .with("patch", patches.clone())?
        .rows("open_circuit_hz", &open_circuit, modes.len())?
        .rows("coupling_squared", &squared, modes.len())?
        .rows(
            "coupling_n_per_v",
            &modes
                .patch
                .values()
                .map(|patch| patch.coupling_n_per_v.clone())
                .collect::<Vec<_>>(),
            modes.len(),
        )?
        .with("beams", shape_dict)?
        .with("held", &hold)?
        .with(
            "manifest",
            spec.manifest("modes", &[("hold", hold.join(" "))]),
        )?;
    Ok(dict
        .array("damping_ratio", modes.damping_ratio)?
        .array("discretisation_error", modes.discretisation_error)?
        .dict())
}
