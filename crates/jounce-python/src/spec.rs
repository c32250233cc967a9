//! A spec: its text, and what the text says.

use crate::branch::json;
use crate::failure::Failure;
use jounce::analysis::Model;
use jounce::integrate::Control;
use jounce::spec::{KeyRange, NumericKey, Quantity, SpecFile};
use jounce::table::Manifest;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::OnceLock;

/// A spec, read and checked. It never changes; a change makes a new one.
#[pyclass(frozen, module = "jounce._core")]
pub struct Spec {
    text: String,
    folder: PathBuf,
    /// What the text says.
    pub spec: jounce::spec::Spec,
    prepared: OnceLock<Model>,
    hash_hex: OnceLock<String>,
}

#[pymethods]
impl Spec {
    /// Reads a text; state files and recordings are looked for in `folder`.
    #[new]
    fn new(text: String, folder: PathBuf) -> Result<Self, Failure> {
        let spec = SpecFile::from_text(text.as_str())
            .in_folder(&folder)
            .spec()?;
        Ok(Self {
            text,
            folder,
            spec,
            prepared: OnceLock::new(),
            hash_hex: OnceLock::new(),
        })
    }

    /// Reads a file.
    #[staticmethod]
    fn read(path: PathBuf) -> Result<Self, Failure> {
        let text = SpecFile::read(&path)?.text();
        Self::new(text, path.parent().map(PathBuf::from).unwrap_or_default())
    }

    /// The same with keys set, all at once.
    fn with_keys(&self, keys: Vec<(String, String)>) -> Result<Self, Failure> {
        let mut file = self.file();
        let faults: Vec<_> = keys
            .iter()
            .filter_map(|(key, value)| file.set(key, value).err())
            .collect();
        if !faults.is_empty() {
            return Err(Failure::faults(&faults));
        }
        let spec = file.spec()?;
        Ok(Self {
            text: file.text(),
            folder: self.folder.clone(),
            spec,
            prepared: OnceLock::new(),
            hash_hex: OnceLock::new(),
        })
    }

    /// The text, comments and layout kept.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// Where state files and recordings are looked for.
    #[getter]
    pub fn folder(&self) -> PathBuf {
        self.folder.clone()
    }

    /// The text in canonical form: every key that applies, with its default.
    fn to_toml(&self) -> String {
        self.spec.to_toml()
    }

    /// What was noticed of the recordings of its drives, as JSON.
    fn findings(&self) -> PyResult<String> {
        let findings: Vec<_> = self
            .spec
            .findings()
            .map(|(_, finding)| finding.clone())
            .collect();
        crate::measured::recording::findings(&findings)
    }

    /// SHA-256 of the canonical form.
    fn hash_hex(&self) -> &str {
        self.hash_hex.get_or_init(|| self.spec.hash_hex())
    }

    /// Value of a key with a number, SI, and its unit.
    fn number(&self, key: &str) -> Result<(f64, String), Failure> {
        let found = NumericKey::find(&self.spec, key)?;
        Ok((found.get(&self.spec)?, found.unit()))
    }

    /// The harvester to scale: as SVG, and as PNG at twice its size.
    fn drawing<'py>(
        &self,
        py: Python<'py>,
        title: &str,
    ) -> PyResult<(String, Bound<'py, PyBytes>)> {
        let drawing = jounce::show::drawing(title, &self.spec);
        let png = py
            .detach(|| drawing.to_png(2.0))
            .map_err(|error| Failure::new("ArgumentError", error).raised(py))?;
        Ok((drawing.to_svg(), PyBytes::new(py, &png)))
    }

    /// Writes the text to a file, whole or not at all.
    fn write(&self, path: PathBuf) -> Result<(), Failure> {
        jounce::store::write(&path, self.text.as_bytes()).map_err(Failure::from)
    }
}

impl Spec {
    /// The harvester, made once and shared by every call, under the control of one call.
    pub fn prepared(&self, control: &Control) -> Result<Model, Failure> {
        let known = match self.prepared.get() {
            Some(known) => known,
            None => {
                let made = Model::watched(self.spec.clone(), control)?;
                // What was made for a call that ends early lacks its noise.
                if control.is_stopped() {
                    return Ok(made);
                }
                let unwatched = made.with_control(&Control::default())?;
                self.prepared.get_or_init(|| unwatched)
            }
        };
        Ok(known.with_control(control)?)
    }

    /// The text, ready to be changed.
    pub fn file(&self) -> SpecFile {
        SpecFile::from_text(self.text.as_str()).in_folder(&self.folder)
    }

    /// A key with a number.
    pub fn key(&self, key: &str) -> Result<NumericKey, Failure> {
        Ok(self.file().numeric_key(key)?)
    }

    /// A key and its values.
    pub fn range(&self, key: &str, values: &str) -> Result<KeyRange, Failure> {
        Ok(KeyRange::parse(self.key(key)?, values)?)
    }

    /// A key and the two ends of its range.
    pub fn ends(
        &self,
        key: &str,
        range: (String, String),
    ) -> Result<(NumericKey, (f64, f64)), Failure> {
        let found = KeyRange::parse(self.key(key)?, &format!("{},{}", range.0, range.1))?;
        match found.values() {
            [low, high] if low < high => Ok((found.key().clone(), (*low, *high))),
            ends => {
                let why = format!(
                    "{key}: the range {} to {} must go from a smaller to a larger value",
                    range.0, range.1
                );
                Err(Failure::new("ArgumentError", why)
                    .with(serde_json::json!({ "key": key, "ends": ends })))
            }
        }
    }

    /// The spec with another tolerance of the march.
    pub fn with_tolerance(&self, tolerance: Option<f64>) -> Result<Option<Self>, Failure> {
        tolerance
            .map(|tolerance| {
                self.with_keys(vec![("run.tolerance".to_owned(), format!("{tolerance:e}"))])
            })
            .transpose()
    }

    /// Where an answer comes from, as JSON.
    pub fn manifest(&self, command: &str, options: &[(&str, String)]) -> String {
        let manifest = Manifest::new(self.hash_hex()).with("command", command);
        let manifest = options.iter().fold(manifest, |manifest, (name, value)| {
            manifest.with(name, value)
        });
        serde_json::to_string(&manifest).unwrap_or_default()
    }
}

/// The JSON Schema of a spec.
#[pyfunction]
pub fn schema() -> PyResult<String> {
    json(&jounce::spec::schema())
}

/// The reference of all keys of a spec, in Markdown.
#[pyfunction]
pub fn keys() -> String {
    jounce::spec::reference_markdown()
}

/// A quantity as text, in SI: kind is `time`, `frequency`, `length`, `resistance`, `capacitance`, `mass` or `force`.
#[pyfunction]
pub fn quantity_si(kind: &str, text: &str) -> PyResult<f64> {
    let quantity = match kind {
        "time" => Quantity::Time,
        "frequency" => Quantity::Frequency,
        "length" => Quantity::Length,
        "resistance" => Quantity::Resistance,
        "capacitance" => Quantity::Capacitance,
        "mass" => Quantity::Mass,
        "force" => Quantity::Force,
        _ => {
            return Err(PyValueError::new_err(format!(
                "{kind}: no kind of quantity"
            )));
        }
    };
    quantity.read(text).map_err(|error| {
        Failure::new("ArgumentError", error)
            .with(serde_json::json!({ "given": text, "due": kind }))
            .into()
    })
}
