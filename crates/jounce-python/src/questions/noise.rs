//! Exact response to noise without contact.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::{NoiseOptions, NoiseResult};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes means and mean squares, and densities over frequency; `options` are the fields of the
/// options of the library, as JSON.
#[pyfunction]
pub fn noise<'py>(py: Python<'py>, spec: &Spec, options: &str) -> PythonResult<'py> {
    let options: NoiseOptions = flat::options(options)?;
    let outcome = cancellable(py, None, |control| {
        Ok(spec.harvester.with_control(control).noise(&options)?)
    });
    let manifest = spec.manifest("noise", &options)?;
    to_python_result(py, outcome, |result| into_python(py, result, manifest))
}

fn into_python(
    py: Python<'_>,
    mut result: NoiseResult,
    manifest: String,
) -> PyResult<Bound<'_, PyDict>> {
    let densities = PyDict::new(py);
    for density in std::mem::take(&mut result.densities) {
        let values = PyArray1::from_vec(py, density.value);
        densities.set_item(density.name, (values, density.unit))?;
    }
    let frequency_hz = std::mem::take(&mut result.frequency_hz);
    let bandwidths = result.loads.iter_mut();
    let bandwidths = bandwidths.map(|load| std::mem::take(&mut load.noise_bandwidth_hz));
    let bandwidths: Vec<Vec<f64>> = bandwidths.collect();
    let dict = flat::dict(py, &result)?
        .rows("load_noise_bandwidth_hz", &bandwidths, result.drives.len())?
        .array("frequency_hz", frequency_hz)?
        .with("densities", densities)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
