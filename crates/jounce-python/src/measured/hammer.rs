//! Frequency responses and modes of a hammer test.

use super::modes::{check_order, identification_dict};
use super::recording::{RecordingInput, findings};
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
        let argument_error = |reason: String| Err(Failure::new("ArgumentError", reason));
        if !(self.noise_ratio > 0.0 && self.noise_ratio.is_finite()) {
            return argument_error(format!(
                "noise_ratio is {}; it must be above 0",
                self.noise_ratio
            ));
        }
        if let Some(ratio) = self
            .end_ratio
            .filter(|ratio| !(*ratio > 0.0 && *ratio < 1.0))
        {
            return argument_error(format!(
                "end_ratio is {ratio}; it must be between 0 and 1; try 0.01"
            ));
        }
        let estimator = match self.estimator.as_str() {
            "h1" => Estimator::H1,
            "h2" => Estimator::H2,
            "hv" => Estimator::Hv {
                noise_ratio: self.noise_ratio,
            },
            name => {
                return argument_error(format!(
                    "estimator is \"{name}\"; it must be \"h1\", \"h2\" or \"hv\""
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
    fn prepare(&self, recordings: Vec<Recording>) -> Result<Vec<Recording>, Failure> {
        let recordings = match self.functions.as_deref() {
            None => recordings,
            Some("re-im") => paired(recordings, ComplexParts::ReIm)?,
            Some("size-degrees") => paired(recordings, ComplexParts::SizeDegrees)?,
            Some("size-radians") => paired(recordings, ComplexParts::SizeRadians)?,
            Some(name) => {
                let reason = format!(
                    "functions is \"{name}\"; it must be \"re-im\", \"size-degrees\" or \"size-radians\""
                );
                return Err(Failure::new("ArgumentError", reason));
            }
        };
        Ok(if self.bridge {
            bridged(recordings)
        } else {
            recordings
        })
    }

    /// Returns the responses of recordings over time; those over frequency are returned unchanged.
    fn responses(
        &self,
        py: Python<'_>,
        inputs: &[RecordingInput<'_>],
    ) -> Result<MeasuredResponses, Failure> {
        let settings = self.settings()?;
        let recordings = self.prepare(
            inputs
                .iter()
                .map(RecordingInput::recording)
                .collect::<Result<Vec<_>, _>>()?,
        )?;
        if recordings
            .iter()
            .all(|recording| recording.over == Over::Frequency)
        {
            return Ok(MeasuredResponses::from_functions(&recordings)?);
        }
        let records = inputs
            .iter()
            .map(RecordingInput::even)
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
        let channels = ChannelChoice {
            excitation,
            responses: self.responses.clone(),
        };
        py.detach(|| Ok(MeasuredResponses::of_hits(&records, &channels, &settings)?))
    }
}

/// Estimates the frequency responses of a hammer test.
#[pyfunction]
pub fn measured_frf<'py>(
    py: Python<'py>,
    recordings: Vec<RecordingInput<'py>>,
    hammer: Hammer,
) -> PyResult<Bound<'py, PyDict>> {
    let responses = hammer.responses(py, &recordings)?;
    Ok(into_python(py, &responses)?.dict())
}

/// Identifies the modes of a hammer test between two frequencies; by default over all lines.
#[pyfunction]
pub fn measured_modes<'py>(
    py: Python<'py>,
    recordings: Vec<RecordingInput<'py>>,
    hammer: Hammer,
    between_hz: Option<(f64, f64)>,
    order: usize,
) -> PyResult<Bound<'py, PyDict>> {
    check_order(order)?;
    let responses = hammer.responses(py, &recordings)?;
    let highest = responses.functions[0]
        .frequency_hz
        .last()
        .copied()
        .unwrap_or(0.0);
    let between_hz = between_hz.unwrap_or((0.0, highest));
    let identification = py.detach(|| {
        let mut identification =
            identify(&Band::of(&responses, between_hz)?, ModalSettings { order })?;
        identification
            .modes
            .iter_mut()
            .for_each(|mode| mode.without_decay(responses.window_decay_per_s));
        Ok::<_, Failure>(identification)
    });
    let identification = identification.map_err(|failure| failure.into_exception(py))?;
    let references = if responses.references.len() > 1 {
        &responses.references[..]
    } else {
        &[]
    };
    let dict = identification_dict(
        py,
        (&responses.outputs, references),
        &responses.names,
        &identification,
    )?;
    let participation = identification
        .modes
        .iter()
        .map(|mode| base_participation(py, mode, &responses))
        .collect::<Vec<_>>();
    Ok(dict
        .with("base_participation", participation)?
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
fn into_python<'py>(py: Python<'py>, responses: &MeasuredResponses) -> PyResult<PythonDict<'py>> {
    let response_dict = PyDict::new(py);
    for ((name, unit), function) in responses
        .names
        .iter()
        .zip(&responses.units)
        .zip(&responses.functions)
    {
        response_dict.set_item(
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
            responses
                .functions
                .first()
                .map_or_else(Vec::new, |function| function.frequency_hz.clone()),
        )?
        .with("responses", response_dict)?
        .with("input", &responses.input)?
        .with(
            "per_g",
            (0..responses.names.len())
                .map(|k| responses.per_g(k))
                .collect::<Vec<_>>(),
        )?
        .with("outputs", &responses.outputs)?
        .with("references", &responses.references)?
        .with("hits", json(&responses.hits)?)?
        .with("block_s", responses.block_s)?
        .with("window_decay_per_s", responses.window_decay_per_s)?
        .with("findings", findings(&responses.findings)?)
}
