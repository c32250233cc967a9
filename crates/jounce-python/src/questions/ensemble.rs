//! Ensembles of realisations of noise.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::VoltageSpectrum;
use jounce::{EnsembleOptions, EnsembleResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Integrates realisations of the noise, in rounds until the interval is narrow enough where a
/// width is required; `options` are the fields of the options of the library, as JSON.
#[pyfunction]
pub fn ensemble<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: EnsembleOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(spec.harvester.with_control(control).ensemble(&options)?)
    });
    let manifest = spec.manifest("ensemble", &options)?;
    to_python_result(py, outcome, |result| into_python(py, &result, manifest))
}

fn into_python<'py>(
    py: Python<'py>,
    result: &EnsembleResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let spectra = || result.patches.iter().map(|patch| &patch.spectrum);
    let frequency_hz = spectra()
        .next()
        .map_or_else(Vec::new, |first| first.frequency_hz.clone());
    let rows = |values: fn(&VoltageSpectrum) -> &Vec<f64>| -> Vec<Vec<f64>> {
        spectra().map(|spectrum| values(spectrum).clone()).collect()
    };
    let bins = frequency_hz.len();
    let density = rows(|spectrum| &spectrum.density_v2_hz);
    let half_width = rows(|spectrum| &spectrum.density_half_width_v2_hz);
    let dict = flat::dict_with_main(py, result, "patches")?
        .with("warnings", result.warnings())?
        .array("frequency_hz", frequency_hz)?
        .rows("voltage_psd_v2_hz", &density, bins)?
        .rows("voltage_psd_half_width_v2_hz", &half_width, bins)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
