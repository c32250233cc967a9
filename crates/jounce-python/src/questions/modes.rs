//! Modes and couplings.

use crate::conversion::arrays::{PythonDict, matrix};
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::{ModesOptions, ModesResult, PlateShapes};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes natural frequencies, damping, couplings and shapes; `options` are the fields of the
/// options of the library, as JSON.
#[pyfunction]
pub fn modes<'py>(py: Python<'py>, spec: &Spec, options: &str) -> PyResult<Bound<'py, PyDict>> {
    let options: ModesOptions = flat::options(options)?;
    let result = py.detach(|| spec.harvester.modes(&options));
    let result = result.map_err(|error| Failure::from(error).into_exception(py))?;
    let manifest = spec.manifest("modes", &options)?;
    into_python(py, &result, manifest)
}

fn into_python<'py>(
    py: Python<'py>,
    result: &ModesResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let beams = PyDict::new(py);
    for beam in &result.beams {
        let place = PyArray1::from_slice(py, &beam.place_m);
        let shapes = matrix(py, &beam.shapes_per_sqrt_kg, beam.place_m.len())?;
        beams.set_item(&beam.name, (place, shapes))?;
    }
    let plates = PyDict::new(py);
    for plate in &result.plates {
        let size = PyArray1::from_slice(py, &plate.size_m);
        plates.set_item(&plate.name, (size, shapes_over(py, plate)?))?;
    }
    let (points, patches, width) = (&result.points, &result.patches, result.modes.len());
    let mut couplings = [(); 4].map(|()| vec![vec![f64::NAN; width]; patches.len()]);
    for one in &result.couplings {
        let patch = patches.iter().position(|patch| patch.name == one.patch);
        if let Some(patch) = patch {
            couplings[0][patch][one.mode] = one.open_circuit_hz;
            couplings[1][patch][one.mode] = one.coupling_squared;
            couplings[2][patch][one.mode] = one.matched_resistance_ohm;
            couplings[3][patch][one.mode] = one.optimal_resistance_ohm;
        }
    }
    let [open, squared, matched, optimal] = couplings;
    let names_of_points: Vec<&String> = points.iter().map(|point| &point.name).collect();
    let names_of_patches: Vec<&String> = patches.iter().map(|patch| &patch.name).collect();
    let shape = points.iter().map(|point| point.shape_per_sqrt_kg.clone());
    let coupling = patches.iter().map(|patch| patch.coupling_n_per_v.clone());
    let dict = PythonDict::new(py)
        .each("frequency_hz", &result.modes, |mode| mode.frequency_hz)?
        .each("damping_ratio", &result.modes, |mode| mode.damping_ratio)?
        .each("discretisation_error", &result.modes, |mode| {
            mode.discretisation_error
        })?
        .with("point", names_of_points)?
        .rows("shape", &shape.collect::<Vec<_>>(), width)?
        .with("patch", names_of_patches)?
        .each("capacitance_f", patches, |patch| patch.capacitance_f)?
        .rows("open_circuit_hz", &open, width)?
        .rows("coupling_squared", &squared, width)?
        .rows("matched_resistance_ohm", &matched, width)?
        .rows("optimal_resistance_ohm", &optimal, width)?
        .rows("coupling_n_per_v", &coupling.collect::<Vec<_>>(), width)?
        .with("beams", beams)?
        .with("plates", plates)?
        .with("held", &result.held)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}

/// Returns the shapes over a plate, by mode, column along the length and row across the width.
fn shapes_over<'py>(py: Python<'py>, plate: &PlateShapes) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let shapes = &plate.shapes_per_sqrt_kg;
    let columns = shapes.first().map_or(0, Vec::len);
    let rows = shapes
        .first()
        .and_then(|shape| shape.first())
        .map_or(0, Vec::len);
    let values = shapes.iter().flatten().flatten().copied().collect();
    PyArray1::from_vec(py, values).reshape([shapes.len(), columns, rows])
}
