//! Modes of structures without a measured force: free decays and output-only tests.

use super::modes::{check_order, identification_dict};
use super::recording::{RecordingInput, findings};
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
    fn decays(&self, py: Python<'_>, recordings: &[RecordingInput<'_>]) -> Result<Decays, Failure> {
        if self.free {
            let records = recordings
                .iter()
                .map(RecordingInput::even)
                .collect::<Result<Vec<_>, _>>()?;
            return py.detach(|| Ok(Decays::free(&records, &self.responses, self.span_s)?));
        }
        let [recording] = recordings else {
            return Err(Failure::new(
                "ArgumentError",
                format!(
                    "output_only takes one recording, but {} are given",
                    recordings.len()
                ),
            ));
        };
        let recording = recording.recording()?;
        if recording.over == Over::Frequency {
            return py.detach(|| Ok(Decays::of_spectrum(&recording, &self.responses)?));
        }
        let (record, responses, references) = (
            recording.even()?,
            self.responses.clone(),
            self.references.clone(),
        );
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
    recordings: Vec<RecordingInput<'py>>,
    unforced: Unforced,
    between_hz: Option<(f64, f64)>,
    order: usize,
) -> PyResult<Bound<'py, PyDict>> {
    check_order(order)?;
    let decays = unforced.decays(py, &recordings)?;
    let between_hz = between_hz.unwrap_or((0.0, 0.5 * decays.rate_hz));
    let identification = py.detach(|| {
        Ok::<_, Failure>(identify_decays(
            &decays,
            between_hz,
            ModalSettings { order },
        )?)
    });
    let identification = identification.map_err(|failure| failure.into_exception(py))?;
    let dict = identification_dict(py, (&decays.outputs, &[]), &decays.names(), &identification)?;
    Ok(dict.with("findings", findings(&decays.findings)?)?.dict())
}
