//! Conversion of recordings from Python and back.

use crate::conversion::arrays::PythonDict;
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::questions::branch::json;
use jounce::parts::{Channel, Grid, Issue, MeasuredQuantity, Over, RawChannel, ShapeResult};
use jounce::{Error, ReadOptions, RecordedFile, Recording};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// Row of numbers, which may be read-only or strided.
type Row<'py> = PyReadonlyArray1<'py, f64>;

/// Recording as passed from Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct RecordingInput<'py> {
    name: String,
    over: String,
    /// Times or frequencies of the samples, s or Hz.
    places: Row<'py>,
    /// Step between samples; `None` where each sample has its own stamp.
    step: Option<f64>,
    channels: Vec<ChannelInput<'py>>,
}

/// Channel of a recording.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct ChannelInput<'py> {
    name: String,
    /// Name of the quantity; `None` for samples in the unit of an instrument.
    quantity: Option<String>,
    unit: String,
    place: String,
    direction: String,
    reference: String,
    values: Row<'py>,
    imaginary: Option<Row<'py>>,
}

impl RecordingInput<'_> {
    /// Converts to a recording of the library, with values in SI.
    pub fn recording(&self) -> Result<Recording, Failure> {
        let channels = self
            .channels
            .iter()
            .map(ChannelInput::channel)
            .collect::<Result<_, Failure>>()?;
        Ok(Recording::new(
            &self.name,
            self.over()?,
            self.grid()?,
            channels,
        ))
    }

    fn over(&self) -> Result<Over, Failure> {
        match self.over.as_str() {
            "time" => Ok(Over::Time),
            "frequency" => Ok(Over::Frequency),
            other => Err(Failure::new(
                "ArgumentError",
                format!("over is \"{other}\"; it must be \"time\" or \"frequency\""),
            )),
        }
    }

    fn grid(&self) -> Result<Grid, Failure> {
        let places = self.places.as_array();
        match self.step {
            Some(step) => {
                let start = places.first().copied().unwrap_or_default();
                Ok(Grid::even(start, step, places.len()).map_err(Error::from)?)
            }
            None => Ok(Grid::Stamped(places.to_vec())),
        }
    }
}

impl ChannelInput<'_> {
    fn raw(&self) -> RawChannel {
        RawChannel {
            name: self.name.clone(),
            unit: self.unit.clone(),
            place: self.place.clone(),
            direction: self.direction.clone(),
            reference: self.reference.clone(),
            values: self.values.as_array().to_vec(),
            imaginary: self.imaginary.as_ref().map(|row| row.as_array().to_vec()),
        }
    }

    fn channel(&self) -> Result<Channel, Failure> {
        let quantity_name = serde_json::Value::from(self.quantity.as_deref().unwrap_or("unknown"));
        let quantity: MeasuredQuantity = serde_json::from_value(quantity_name)
            .map_err(|error| Failure::new("ArgumentError", error))?;
        let RawChannel {
            name,
            unit,
            place,
            direction,
            reference,
            values,
            imaginary,
        } = self.raw();
        Ok(Channel {
            name,
            quantity,
            unit,
            place,
            direction,
            reference,
            values,
            imaginary,
        })
    }
}

/// Reads everything in a file; `options` are the fields of the options of the library, as JSON.
#[pyfunction]
pub fn recording_read<'py>(
    py: Python<'py>,
    path: PathBuf,
    options: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let options: ReadOptions = flat::options(options)?;
    let contents = py.detach(|| {
        let file = RecordedFile::read(&path, &options)?;
        let result = file.result();
        Ok((file.into_recordings()?, result))
    });
    let (recordings, result) =
        contents.map_err(|error: Error| Failure::from(error).into_exception(py))?;
    let recordings = recordings
        .into_iter()
        .map(|recording| into_python(py, recording))
        .collect::<PyResult<Vec<_>>>()?;
    let shapes = result
        .shapes
        .iter()
        .map(|mode_shape| shape(py, mode_shape))
        .collect::<PyResult<Vec<_>>>()?;
    let dict = PythonDict::new(py)
        .with("recordings", recordings)?
        .with("shapes", shapes)?;
    Ok(dict.with("issues", issues(&result.issues)?)?.dict())
}

/// Converts samples with units of instruments to a recording in SI.
#[pyfunction]
pub fn recording_from_arrays<'py>(
    py: Python<'py>,
    recording_input: RecordingInput<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let (over, stamps) = (
        recording_input.over()?,
        recording_input.places.as_array().to_vec(),
    );
    let (grid, stamp_issues) = match recording_input.step {
        Some(_) => (recording_input.grid()?, Vec::new()),
        None => Grid::from_stamps(stamps).map_err(|error| Failure::from(Error::from(error)))?,
    };
    let channels = recording_input
        .channels
        .iter()
        .map(ChannelInput::raw)
        .collect();
    let name = &recording_input.name;
    let recording = Recording::from_arrays(name, over, grid, channels).map_err(Failure::from)?;
    into_python(py, recording.with_issues(stamp_issues))
}

/// Converts a recording to even steps without missing samples.
#[pyfunction]
pub fn recording_even<'py>(
    py: Python<'py>,
    recording_input: RecordingInput<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let recording = recording_input.recording()?;
    let uniform = py
        .detach(|| recording.even())
        .map_err(|error| Failure::from(error).into_exception(py))?;
    into_python(py, uniform)
}

/// Writes a recording in the format of the ending of the path.
#[pyfunction]
pub fn recording_write(
    py: Python<'_>,
    recording_input: RecordingInput<'_>,
    path: PathBuf,
) -> PyResult<()> {
    let recording = recording_input.recording()?;
    py.detach(|| recording.write(&path))
        .map_err(|error| Failure::from(error).into_exception(py))
}

/// Converts a recording for Python.
pub fn into_python(py: Python<'_>, recording: Recording) -> PyResult<Bound<'_, PyDict>> {
    let recording = recording.into_data();
    let step = match &recording.grid {
        Grid::Even { step, .. } => Some(*step),
        Grid::Stamped(_) => None,
    };
    let dict = PythonDict::new(py)
        .with(
            "over",
            if recording.over == Over::Time {
                "time"
            } else {
                "frequency"
            },
        )?
        .with("issues", issues(&recording.issues)?)?
        .with("rate", recording.rate())?
        .with("step", step)?
        .array("places", recording.grid.places())?
        .with("name", recording.name)?;
    let channels = recording
        .channels
        .into_iter()
        .map(|item| channel(py, item))
        .collect::<PyResult<Vec<_>>>()?;
    Ok(dict.with("channels", channels)?.dict())
}

fn channel(py: Python<'_>, channel: Channel) -> PyResult<Bound<'_, PyDict>> {
    let dict = PythonDict::new(py)
        .with("quantity", json(&channel.quantity)?.trim_matches('"'))?
        .with("name", channel.name)?
        .with("unit", channel.unit)?
        .with("place", channel.place)?
        .with("direction", channel.direction)?
        .with("reference", channel.reference)?
        .with(
            "imaginary",
            channel
                .imaginary
                .map(|imaginary| PyArray1::from_vec(py, imaginary)),
        )?
        .array("values", channel.values)?;
    Ok(dict.dict())
}

fn shape<'py>(py: Python<'py>, shape: &ShapeResult) -> PyResult<Bound<'py, PyDict>> {
    let width = shape.real.first().map_or(0, Vec::len);
    let dict = PythonDict::new(py)
        .with("frequency_hz", shape.frequency_hz)?
        .with("damping_ratio", shape.damping_ratio)?
        .with("modal_mass", shape.modal_mass)?
        .array("node", shape.nodes.clone())?
        .rows("real", &shape.real, width)?;
    let zeros = vec![vec![0.0; width]; shape.real.len()];
    Ok(dict
        .rows(
            "imaginary",
            shape.imaginary.as_ref().unwrap_or(&zeros),
            width,
        )?
        .dict())
}

/// Formats issues as JSON, each with its message.
pub fn issues(issues: &[Issue]) -> PyResult<String> {
    let issue_json = |issue: &Issue| {
        serde_json::json!({
            "kind": issue.kind,
            "channel": issue.channel,
            "count": issue.count,
            "first": issue.first.map(|first| first.to_string()),
            "text": issue.to_string(),
        })
    };
    json(&issues.iter().map(issue_json).collect::<Vec<_>>())
}

/// Converts recordings from Python.
pub fn recordings(inputs: &[RecordingInput<'_>]) -> Result<Vec<Recording>, Failure> {
    inputs.iter().map(RecordingInput::recording).collect()
}
