//! Spec: its text and its contents.

use crate::conversion::failure::Failure;
use jounce::parts::{Quantity, quantity_range};
use jounce::{Harvester, SpecFile};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use std::path::PathBuf;

/// Spec that is read and checked. It is immutable; a change returns a new one.
#[pyclass(frozen, module = "jounce._core")]
pub struct Spec {
    /// The harvester of the text.
    pub harvester: Harvester,
    text: String,
}

#[pymethods]
impl Spec {
    /// Reads a text; paths of state files and recordings are relative to `folder`.
    #[new]
    fn new(text: String, folder: PathBuf) -> Result<Self, Failure> {
        Ok(Self::of(Harvester::from_text(&text, folder)?))
    }

    /// Reads a file.
    #[staticmethod]
    fn read(path: PathBuf) -> Result<Self, Failure> {
        Ok(Self::of(Harvester::read(path)?))
    }

    /// Returns a copy with keys set, all at once.
    fn with_keys(&self, keys: Vec<(String, String)>) -> Result<Self, Failure> {
        let values = keys
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()));
        Ok(Self::of(self.harvester.changed(values)?))
    }

    /// Returns the text, with comments and layout.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// Returns the folder of state files and recordings.
    #[getter]
    pub fn folder(&self) -> PathBuf {
        self.harvester.folder().to_path_buf()
    }

    /// Returns the text in canonical form: every key that applies, with its default.
    fn to_toml(&self) -> String {
        self.spec().to_toml()
    }

    /// Returns the issues of the recordings of its drives, as JSON.
    fn issues(&self) -> PyResult<String> {
        let issues = self.harvester.issues();
        let issues: Vec<_> = issues.map(|(_, issue)| issue.clone()).collect();
        crate::measured::recording::issues(&issues)
    }

    /// Returns the SHA-256 of the canonical form.
    fn hash_hex(&self) -> &str {
        self.harvester.hash_hex()
    }

    /// Returns the value of a key with a number, SI, and its unit.
    fn number(&self, key: &str) -> Result<(f64, String), Failure> {
        let value = self.harvester.get(key)?;
        Ok((value.value_si, value.unit))
    }

    /// Draws the harvester to scale: as SVG, and as PNG at twice its size.
    fn drawing<'py>(
        &self,
        py: Python<'py>,
        title: &str,
    ) -> PyResult<(String, Bound<'py, PyBytes>)> {
        let drawing = self.harvester.drawing(title);
        let png = py
            .detach(|| drawing.to_png(2.0))
            .map_err(|error| Failure::new("ArgumentError", error).into_exception(py))?;
        Ok((drawing.to_svg(), PyBytes::new(py, &png)))
    }

    /// Writes the text to a file, completely or not at all.
    fn write(&self, path: PathBuf) -> Result<(), Failure> {
        Ok(self.harvester.write(path)?)
    }
}

impl Spec {
    /// Returns the spec of a harvester.
    pub fn of(harvester: Harvester) -> Self {
        let text = harvester.text();
        Self { harvester, text }
    }

    /// Returns the contents of the spec.
    pub fn spec(&self) -> &jounce::Spec {
        self.harvester.spec()
    }

    /// Returns a modifiable copy of the text.
    pub fn file(&self) -> SpecFile {
        self.harvester.file().clone()
    }

    /// Returns the origin of a result, as JSON.
    pub fn manifest(&self, question: &str, options: &impl Serialize) -> Result<String, Failure> {
        let manifest = self.harvester.manifest(question, options)?;
        serde_json::to_string(&manifest).map_err(|error| Failure::new("JounceError", error))
    }
}

/// Returns the questions with their names and options, as JSON.
#[pyfunction]
pub fn questions() -> PyResult<String> {
    let questions = serde_json::to_string(&jounce::questions());
    Ok(questions.map_err(|error| Failure::new("JounceError", error))?)
}

/// Returns the JSON Schema of a spec.
#[pyfunction]
pub fn schema() -> String {
    jounce::schema().to_string()
}

/// Returns the reference of all keys of a spec, in Markdown.
#[pyfunction]
pub fn keys() -> String {
    jounce::key_reference()
}

/// True for the text of a unit.
#[pyfunction]
pub fn is_unit(text: &str) -> bool {
    jounce::parts::is_unit(text)
}

/// Converts a quantity as text to SI: kind is `time`, `frequency`, `length`, `resistance`,
/// `capacitance`, `mass`, `force`, `speed` or `pressure`.
#[pyfunction]
pub fn quantity_si(kind: &str, text: &str) -> PyResult<f64> {
    let value = quantity(kind)?.read(text);
    value.map_err(|error| invalid(kind, text, error.to_string()))
}

/// Converts a range as text to its values, SI; kind is one of [`quantity_si`].
#[pyfunction]
pub fn quantities_si(kind: &str, text: &str) -> PyResult<Vec<f64>> {
    let values = quantity_range(quantity(kind)?, text);
    values.map_err(|reason| invalid(kind, text, reason))
}

fn quantity(kind: &str) -> PyResult<Quantity> {
    let known = match kind {
        "time" => Quantity::Time,
        "frequency" => Quantity::Frequency,
        "length" => Quantity::Length,
        "resistance" => Quantity::Resistance,
        "capacitance" => Quantity::Capacitance,
        "mass" => Quantity::Mass,
        "force" => Quantity::Force,
        "speed" => Quantity::Speed,
        "pressure" => Quantity::Pressure,
        _ => {
            let message = format!("{kind}: unknown kind of quantity");
            return Err(PyValueError::new_err(message));
        }
    };
    Ok(known)
}

fn invalid(kind: &str, text: &str, reason: String) -> PyErr {
    Failure::new("ArgumentError", reason)
        .with(serde_json::json!({ "given": text, "due": kind }))
        .into()
}
