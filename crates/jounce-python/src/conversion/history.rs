//! Samples of the stored end of a run, as arrays.

use super::arrays::PythonDict;
use jounce::parts::{History, HistorySamples};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Converts the samples for Python.
pub fn dict<'py>(py: Python<'py>, history: History) -> PyResult<Bound<'py, PyDict>> {
    let dict = PythonDict::new(py)
        .with("point", history.point)?
        .with("patch", history.patch)?
        .with("stop", history.stop)?
        .with("storage", history.storage)?
        .with("sample_rate_hz", history.sample_rate_hz)?;
    let dict = samples(dict, history.even, "")?;
    Ok(samples(dict, history.poincare, "poincare_")?.dict())
}

fn samples<'py>(
    dict: PythonDict<'py>,
    samples: HistorySamples,
    prefix: &str,
) -> PyResult<PythonDict<'py>> {
    let columns = samples.time_s.len();
    let rows = [
        ("displacement_m", &samples.displacement_m),
        ("velocity_m_s", &samples.velocity_m_s),
        ("relative_displacement_m", &samples.relative_displacement_m),
        ("voltage_v", &samples.voltage_v),
        ("force_n", &samples.force_n),
        ("storage_voltage_v", &samples.storage_voltage_v),
    ];
    let mut dict = dict;
    for (name, rows) in rows {
        dict = dict.rows(&format!("{prefix}{name}"), rows, columns)?;
    }
    dict.array(&format!("{prefix}time_s"), samples.time_s)
}
