//! Modes of a hammer or shaker test, of free decays and of output-only tests.

use super::frf::{self, complex};
use super::recording::{RecordingInput, issues, recordings};
use crate::conversion::arrays::PythonDict;
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use jounce::parts::{ComplexValues, MeasuredMode};
use jounce::{MeasuredFrfOptions, MeasuredModesOptions, MeasuredModesResult, Recording};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Identifies the modes of a test; `test` and `options` are the fields of the options of the
/// library, as JSON.
#[pyfunction]
pub fn measured_modes<'py>(
    py: Python<'py>,
    inputs: Vec<RecordingInput<'py>>,
    test: &str,
    options: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let test: MeasuredFrfOptions = flat::options(test)?;
    let options: MeasuredModesOptions = flat::options(options)?;
    let recordings = recordings(&inputs)?;
    let result = py
        .detach(|| Recording::measured_modes(&recordings, &test, &options))
        .map_err(|error| Failure::from(error).into_exception(py))?;
    into_python(py, &result)
}

fn into_python<'py>(py: Python<'py>, result: &MeasuredModesResult) -> PyResult<Bound<'py, PyDict>> {
    let (modes, fit) = (&result.modes, &result.identification);
    let stable: Vec<_> = result
        .stabilisation
        .iter()
        .map(|pole| flat::object(py, &serde_json::json!(pole.stable)))
        .collect::<PyResult<_>>()?;
    let of_modes = |values: fn(&MeasuredMode) -> &ComplexValues| {
        let arrays = modes.iter().map(values);
        let arrays = arrays.map(|values| complex(py, &values.re, &values.im));
        arrays.collect::<Vec<_>>()
    };
    let frf = result.frf.as_ref();
    let frf = frf.map(|frf| frf::into_python(py, frf)).transpose()?;
    let dict = PythonDict::new(py)
        .each("frequency_hz", modes, |mode| mode.frequency_hz)?
        .each("frequency_deviation_hz", modes, |mode| {
            mode.frequency_deviation_hz
        })?
        .each("damping_ratio", modes, |mode| mode.damping_ratio)?
        .each("damping_deviation", modes, |mode| mode.damping_deviation)?
        .with(
            "doubtful",
            modes.iter().map(|mode| mode.doubtful).collect::<Vec<_>>(),
        )?
        .each("quantile_95", modes, |mode| mode.quantile_95)?
        .with("response", &result.responses)?
        .with("function", &result.functions)?
        .with("shape", of_modes(|mode| &mode.shape))?
        .with("reference", &result.references)?
        .with("participation", of_modes(|mode| &mode.participation))?
        .with("base_participation", base_participation(py, modes))?
        .rows("mac", &result.mac, modes.len())?
        .with("misfit", result.misfit)?
        .each("unexplained_hz", &result.unexplained, |peak| {
            peak.frequency_hz
        })?
        .each("pole_order", &result.stabilisation, |pole| {
            pole.order as i64
        })?
        .each("pole_frequency_hz", &result.stabilisation, |pole| {
            pole.pole.frequency_hz
        })?
        .each("pole_damping_ratio", &result.stabilisation, |pole| {
            pole.pole.damping_ratio
        })?
        .with("pole_stable", stable)?
        .array("line_hz", fit.frequency_hz.clone())?
        .with("measured", lines(py, &fit.measured))?
        .with("model", lines(py, &fit.model))?
        .with("frf", frf)?
        .with("warnings", result.warnings())?
        .with("notes", result.notes())?
        .with("issues", issues(&result.issues)?)?;
    Ok(dict.dict())
}

/// Returns the participation of the base in each mode; empty for another input.
fn base_participation<'py>(
    py: Python<'py>,
    modes: &[MeasuredMode],
) -> Vec<Bound<'py, PyArray1<Complex64>>> {
    let values = |mode: &MeasuredMode| {
        let parts = mode.base_participation.iter().flatten();
        let values = parts.map(|part| Complex64::new(part.re, part.im));
        PyArray1::from_vec(py, values.collect())
    };
    modes.iter().map(values).collect()
}

/// Returns an array of the lines of each function.
fn lines<'py>(
    py: Python<'py>,
    functions: &[Vec<Complex64>],
) -> Vec<Bound<'py, PyArray1<Complex64>>> {
    let array = |lines: &Vec<Complex64>| PyArray1::from_slice(py, lines);
    functions.iter().map(array).collect()
}
