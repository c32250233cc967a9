//! Spectra of sampled signals.

use crate::conversion::failure::Failure;
use jounce::parts::{Samples, SignalError, Window};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

/// Array of one axis.
type Row<'py> = Bound<'py, PyArray1<f64>>;

/// Returns frequencies and amplitudes (zero to peak) of the spectrum of a signal, Hann window.
#[pyfunction]
pub fn spectrum<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    sample_rate_hz: f64,
) -> PyResult<(Row<'py>, Row<'py>)> {
    let values = values.as_array().to_vec();
    let result = py.detach(|| {
        Ok::<_, SignalError>(Samples::new(&values, sample_rate_hz)?.spectrum(Window::Hann))
    });
    let result = result.map_err(|error| Failure::of("ArgumentError", &error).into_exception(py))?;
    Ok((
        PyArray1::from_vec(py, result.frequency_hz),
        PyArray1::from_vec(py, result.amplitude_peak),
    ))
}
