//! Modes of structures without a measured force: free decays and output-only tests.

use super::modes::{check_order, identified};
use super::recording::{GivenRecording, findings};
use crate::failure::Failure;
use jounce_measure::modal::{ModalSettings, identify_decays};
use jounce_measure::recording::Over;
use jounce_measure::response::{AmbientSettings, Decays};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Options for recordings without a measured force.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Unforced {
    responses: Vec<String>,
    /// True where the recordings are free decays; else there is one of outputs under noise.
    free: bool,
    span_s: Option<(f64, f64)>,
    references: Vec<String>,
    lags_s: Option<f64>,
}

impl Unforced {
    fn decays(&self, py: Python<'_>, given: &[GivenRecording<'_>]) -> Result<Decays, Failure> {
        if self.free {
            let records = given
                .iter()
                .map(GivenRecording::even)
                .collect::<Result<Vec<_>, _>>()?;
            return py.detach(|| Ok(Decays::free(&records, &self.responses, self.span_s)?));
        }
        let [one] = given else {
            return Err(Failure::new(
                "ArgumentError",
                format!(
                    "output_only takes one recording, but {} are given",
                    given.len()
                ),
            ));
        };
        let recording = one.recording()?;
        if recording.over == Over::Frequency {
            return py.detach(|| Ok(Decays::of_spectrum(&recording, &self.responses)?));
        }
        let (record, responses, references) =
            (one.even()?, self.responses.clone(), self.references.clone());
        py.detach(|| {
            Ok(Decays::ambient(
                &record,
                &AmbientSettings {
                    responses,
                    references,
                    lags_s: self.lags_s,
                },
            )?)
        })
    }
}

/// Identifies the modes of free decays or of outputs only, between two frequencies; by default over
/// all lines.
#[pyfunction]
pub fn measured_decays<'py>(
    py: Python<'py>,
    given: Vec<GivenRecording<'py>>,
    unforced: Unforced,
    between_hz: Option<(f64, f64)>,
    order: usize,
) -> PyResult<Bound<'py, PyDict>> {
    check_order(order)?;
    let decays = unforced.decays(py, &given)?;
    let between_hz = between_hz.unwrap_or((0.0, 0.5 * decays.rate_hz));
    let found = py.detach(|| {
        Ok::<_, Failure>(identify_decays(
            &decays,
            between_hz,
            ModalSettings { order },
        )?)
    });
    let found = found.map_err(|failure| failure.raised(py))?;
    let answer = identified(py, (&decays.outputs, &[]), &decays.names(), &found)?;
    Ok(answer.with("findings", findings(&decays.findings)?)?.dict())
}
