//! Mean power of recorded voltages.

use super::recording::{RecordingInput, issues, recordings};
use crate::conversion::arrays::PythonDict;
use crate::conversion::cancellable::{detached, to_python_result};
use crate::conversion::flat;
use crate::questions::run::PythonResult;
use jounce::parts::{PowerRecord, Spectrum};
use jounce::{PowerOptions, PowerResult, Recording};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes the mean power of the voltage of each recording over its load; `options` are the fields
/// of the options of the library, as JSON.
#[pyfunction]
pub fn power<'py>(
    py: Python<'py>,
    inputs: Vec<RecordingInput<'py>>,
    options: &str,
) -> PythonResult<'py> {
    let recordings = recordings(&inputs)?;
    let options = PowerOptions {
        spectra: true,
        ..flat::options(options)?
    };
    let outcome = detached(py, move |control| {
        let watched = recordings.into_iter().map(|one| one.with_control(control));
        Ok(Recording::power(&watched.collect::<Vec<_>>(), &options)?)
    });
    to_python_result(py, outcome, |result| into_python(py, &result))
}

fn into_python<'py>(py: Python<'py>, result: &PowerResult) -> PyResult<Bound<'py, PyDict>> {
    let records = &result.records;
    // A recording resolves fewer multiples of the drive than one with a higher rate.
    let longest = records.iter().max_by_key(|record| record.orders.len());
    let orders = longest.map_or(&[][..], |record| &record.orders);
    let amplitudes = |record: &PowerRecord| {
        let mut row: Vec<f64> = record
            .orders
            .iter()
            .map(|one| one.amplitude_peak_v)
            .collect();
        row.resize(orders.len(), f64::NAN);
        row
    };
    let rows: Vec<Vec<f64>> = records.iter().map(amplitudes).collect();
    let spectrum = |spectrum: &Spectrum| {
        let dict = PythonDict::new(py).array("frequency_hz", spectrum.frequency_hz.clone())?;
        let dict = dict.array("amplitude_peak", spectrum.amplitude_peak.clone())?;
        Ok(dict.dict())
    };
    let spectra = records.iter().filter_map(|record| record.spectrum.as_ref());
    let spectra = spectra.map(spectrum).collect::<PyResult<Vec<_>>>()?;
    let found: Vec<_> = records
        .iter()
        .flat_map(|record| record.issues.clone())
        .collect();
    let dict = flat::dict_with_main(py, result, "records")?
        .each("order", orders, |one| one.order)?
        .rows("order_amplitude_peak_v", &rows, orders.len())?
        .with("spectra", spectra)?
        .with("issues", issues(&found)?)?;
    Ok(dict.dict())
}
