//! Frequency responses and modes of a hammer test.

use super::modes::{check_order, identified};
use super::recording::{GivenRecording, findings};
use crate::arrays::PythonDict;
use crate::branch::json;
use crate::failure::Failure;
use jounce_measure::modal::{Band, ModalSettings, Mode, identify};
use jounce_measure::recording::{Over, Recording};
use jounce_measure::response::{
    ChannelChoice, ComplexParts, Excitation, MeasuredResponses, bridged, paired,
};
use jounce_measure::spectral::{Estimator, ImpactSettings};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Options of the estimation from a hammer test.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Hammer {
    force: Option<String>,
    input: Option<String>,
    responses: Vec<String>,
    estimator: String,
    noise_ratio: f64,
    block_s: Option<f64>,
    force_window: bool,
    end_ratio: Option<f64>,
    shaker: bool,
    functions: Option<String>,
    bridge: bool,
}

impl Hammer {
    fn settings(&self) -> Result<ImpactSettings, Failure> {
        let wrong = |why: String| Err(Failure::new("ArgumentError", why));
        if !(self.noise_ratio > 0.0 && self.noise_ratio.is_finite()) {
            return wrong(format!(
                "noise_ratio is {}; it must be above 0",
                self.noise_ratio
            ));
        }
        if let Some(ratio) = self
            .end_ratio
            .filter(|ratio| !(*ratio > 0.0 && *ratio < 1.0))
        {
            return wrong(format!(
                "end_ratio is {ratio}; it must be between 0 and 1; try 0.01"
            ));
        }
        let estimator = match self.estimator.as_str() {
            "h1" => Estimator::H1,
            "h2" => Estimator::H2,
            "hv" => Estimator::Hv {
                noise_ratio: self.noise_ratio,
            },
            other => {
                return wrong(format!(
                    "estimator is \"{other}\"; it must be \"h1\", \"h2\" or \"hv\""
                ));
            }
        };
        let Self {
            block_s,
            force_window,
            end_ratio,
            shaker,
            ..
        } = *self;
        Ok(ImpactSettings {
            estimator,
            block_s,
            force_window,
            end_ratio,
            shaker,
        })
    }

    /// Returns recordings with their columns paired and their lines interpolated as requested.
    fn prepared(&self, recordings: Vec<Recording>) -> Result<Vec<Recording>, Failure> {
        let found = match self.functions.as_deref() {
            None => recordings,
            Some("re-im") => paired(recordings, ComplexParts::ReIm)?,
            Some("size-degrees") => paired(recordings, ComplexParts::SizeDegrees)?,
            Some("size-radians") => paired(recordings, ComplexParts::SizeRadians)?,
            Some(other) => {
                let why = format!(
                    "functions is \"{other}\"; it must be \"re-im\", \"size-degrees\" or \"size-radians\""
                );
                return Err(Failure::new("ArgumentError", why));
            }
        };
        Ok(if self.bridge { bridged(found) } else { found })
    }

    /// Returns the responses of recordings over time; those over frequency are returned unchanged.
    fn responses(
        &self,
        py: Python<'_>,
        given: &[GivenRecording<'_>],
    ) -> Result<MeasuredResponses, Failure> {
        let settings = self.settings()?;
        let recordings = self.prepared(
            given
                .iter()
                .map(GivenRecording::recording)
                .collect::<Result<Vec<_>, _>>()?,
        )?;
        if recordings
            .iter()
            .all(|recording| recording.over == Over::Frequency)
        {
            return Ok(MeasuredResponses::from_functions(&recordings)?);
        }
        let records = given
            .iter()
            .map(GivenRecording::even)
            .collect::<Result<Vec<_>, _>>()?;
        let excitation = match (&self.input, &self.force) {
            (Some(_), Some(_)) => {
                return Err(Failure::new(
                    "ArgumentError",
                    "force and input are both given; give one of them",
                ));
            }
            (Some(channel), None) => Excitation::Channel(channel.clone()),
            (None, Some(channel)) => Excitation::Force(channel.clone()),
            (None, None) => Excitation::FirstForce,
        };
        let chosen = ChannelChoice {
            excitation,
            responses: self.responses.clone(),
        };
        py.detach(|| Ok(MeasuredResponses::of_hits(&records, &chosen, &settings)?))
    }
}

/// Estimates the frequency responses of a hammer test.
#[pyfunction]
pub fn measured_frf<'py>(
    py: Python<'py>,
    given: Vec<GivenRecording<'py>>,
    hammer: Hammer,
) -> PyResult<Bound<'py, PyDict>> {
    let found = hammer.responses(py, &given)?;
    Ok(into_python(py, &found)?.dict())
}

/// Identifies the modes of a hammer test between two frequencies; by default over all lines.
#[pyfunction]
pub fn measured_modes<'py>(
    py: Python<'py>,
    given: Vec<GivenRecording<'py>>,
    hammer: Hammer,
    between_hz: Option<(f64, f64)>,
    order: usize,
) -> PyResult<Bound<'py, PyDict>> {
    check_order(order)?;
    let responses = hammer.responses(py, &given)?;
    let highest = responses.functions[0]
        .frequency_hz
        .last()
        .copied()
        .unwrap_or(0.0);
    let between_hz = between_hz.unwrap_or((0.0, highest));
    let found = py.detach(|| {
        let mut found = identify(&Band::of(&responses, between_hz)?, ModalSettings { order })?;
        found
            .modes
            .iter_mut()
            .for_each(|mode| mode.without_decay(responses.window_decay_per_s));
        Ok::<_, Failure>(found)
    });
    let found = found.map_err(|failure| failure.raised(py))?;
    let references = if responses.references.len() > 1 {
        &responses.references[..]
    } else {
        &[]
    };
    let answer = identified(
        py,
        (&responses.outputs, references),
        &responses.names,
        &found,
    )?;
    let base = found
        .modes
        .iter()
        .map(|mode| base_participation(py, mode, &responses))
        .collect::<Vec<_>>();
    Ok(answer
        .with("base_participation", base)?
        .with("frf", into_python(py, &responses)?.dict())?
        .dict())
}

/// Returns the base participation of each output in a mode; empty for another input.
fn base_participation<'py>(
    py: Python<'py>,
    mode: &Mode,
    responses: &MeasuredResponses,
) -> Bound<'py, PyArray1<Complex64>> {
    let parts = mode.base_participation(responses).unwrap_or_default();
    PyArray1::from_vec(
        py,
        parts
            .iter()
            .map(|part| Complex64::new(part.re, part.im))
            .collect(),
    )
}

/// Converts responses for Python.
fn into_python<'py>(py: Python<'py>, found: &MeasuredResponses) -> PyResult<PythonDict<'py>> {
    let all = PyDict::new(py);
    for ((name, unit), function) in found.names.iter().zip(&found.units).zip(&found.functions) {
        all.set_item(
            name,
            (
                PyArray1::from_slice(py, &function.value),
                unit,
                PyArray1::from_slice(py, &function.coherence),
            ),
        )?;
    }
    PythonDict::new(py)
        .array(
            "frequency_hz",
            found
                .functions
                .first()
                .map_or_else(Vec::new, |function| function.frequency_hz.clone()),
        )?
        .with("responses", all)?
        .with("input", &found.input)?
        .with(
            "per_g",
            (0..found.names.len())
                .map(|k| found.per_g(k))
                .collect::<Vec<_>>(),
        )?
        .with("outputs", &found.outputs)?
        .with("references", &found.references)?
        .with("hits", json(&found.hits)?)?
        .with("block_s", found.block_s)?
        .with("window_decay_per_s", found.window_decay_per_s)?
        .with("findings", findings(&found.findings)?)
}
