//! Studies in parts.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::study::{Folder, Shard, StudyError};
use jounce_core::table::{Table, Values};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;

/// Study that is read and checked.
#[pyclass(frozen, module = "jounce._core")]
pub struct Study(jounce_core::study::Study);

#[pymethods]
impl Study {
    /// Reads a study of a spec from the text of its variation.
    #[new]
    fn new(spec: &Spec, text: &str) -> Result<Self, Failure> {
        Ok(Self(jounce_core::study::Study::with_spec(
            spec.file(),
            &spec.folder(),
            text,
        )?))
    }

    /// Returns the SHA-256 of all inputs of the table.
    fn hash_hex(&self) -> &str {
        self.0.hash_hex()
    }

    /// Returns the number of points.
    fn points(&self) -> usize {
        self.0.design.len()
    }

    /// Returns the number of parts.
    fn parts(&self) -> usize {
        self.0.parts()
    }

    /// Returns the number of points of a part.
    fn points_of(&self, part: usize) -> usize {
        self.0.points(part).len()
    }

    /// Returns the values of the keys at a point, SI.
    fn point(&self, index: usize) -> Result<Vec<f64>, Failure> {
        match index < self.0.design.len() {
            true => Ok(self.0.design.point(index)),
            false => {
                let (points, text) = (
                    self.0.design.len(),
                    format!(
                        "there is no point {index}; the study has {}",
                        self.0.design.len()
                    ),
                );
                Err(Failure::new("ArgumentError", text)
                    .with(serde_json::json!({ "point": index, "points": points })))
            }
        }
    }

    /// Returns a part as the bytes of its file, computed on one thread.
    fn part<'py>(&self, py: Python<'py>, part: usize) -> PythonResult<'py> {
        if part >= self.0.parts() {
            let reason = format!("there is no part {part}; the study has {}", self.0.parts());
            let details = serde_json::json!({ "part": part, "parts": self.0.parts() });
            return Err(Failure::new("ArgumentError", reason)
                .with(details)
                .into_exception(py));
        }
        let outcome = cancellable(py, None, |control| {
            let table = self.0.part(part, control)?;
            let bytes = table
                .map(|table| table.to_parquet(&self.0.part_manifest(part)))
                .transpose()
                .map_err(StudyError::from)?;
            bytes
                .map(|bytes| (bytes, control.wall_time_s()))
                .ok_or_else(|| Failure::new("JounceError", "stopped"))
        });
        to_python_result(py, outcome, |(bytes, wall_time_s)| {
            Ok(PythonDict::new(py)
                .with("bytes", PyBytes::new(py, &bytes))?
                .with("wall_time_s", wall_time_s)?
                .dict())
        })
    }

    /// Computes the missing parts of a shard of the study in a folder, on all threads.
    fn run<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
        shard: &str,
        threads: Option<usize>,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PythonResult<'py> {
        let shard: Shard = shard
            .parse()
            .map_err(|error: String| Failure::new("ArgumentError", error).into_exception(py))?;
        let outcome = cancellable(py, progress.as_ref(), |control| {
            let folder = Folder::of(&folder, &self.0)?;
            on_threads(threads, || {
                Ok(folder.run(&self.0, shard, control, &|_| ())?)
            })?;
            Ok(control.wall_time_s())
        });
        to_python_result(py, outcome, |wall_time_s| {
            Ok(PythonDict::new(py).with("wall_time_s", wall_time_s)?.dict())
        })
    }

    /// Returns the numbers of the parts that a folder lacks; a missing folder is created.
    fn missing(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<usize>> {
        py.detach(|| Ok::<_, Failure>(Folder::of(&folder, &self.0)?.missing()))
            .map_err(|failure| failure.into_exception(py))
    }

    /// Stores a part that was computed elsewhere.
    fn keep(&self, py: Python<'_>, folder: PathBuf, part: usize, bytes: &[u8]) -> PyResult<()> {
        let result =
            py.detach(|| Ok::<_, Failure>(Folder::of(&folder, &self.0)?.keep(part, bytes)?));
        result.map_err(|failure| failure.into_exception(py))
    }
}

/// Joins the parts of a folder into one table and returns its path.
#[pyfunction]
pub fn study_merge(py: Python<'_>, folder: PathBuf) -> PyResult<PathBuf> {
    py.detach(|| Ok::<_, Failure>(Folder::open(&folder)?.merge()?))
        .map_err(|failure| failure.into_exception(py))
}

/// Returns the progress of the study in a folder, as JSON.
#[pyfunction]
pub fn study_status(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    let status = py
        .detach(|| Ok::<_, Failure>(Folder::open(&folder)?.status()))
        .map_err(|failure| failure.into_exception(py))?;
    Ok(serde_json::to_string(&status).map_err(|error| Failure::new("JounceError", error))?)
}

/// Reads a table written by jounce: columns by name, their units and meanings, the manifest as
/// JSON.
#[pyfunction]
pub fn table_read<'py>(
    py: Python<'py>,
    path: PathBuf,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>, String)> {
    let table = py
        .detach(|| Table::read(&path))
        .map_err(|error| Failure::from(error).into_exception(py))?;
    let (columns, notes) = (PyDict::new(py), PyDict::new(py));
    for column in table.0.columns() {
        notes.set_item(&column.name, (&column.unit, &column.about))?;
        match &column.values {
            Values::Float(values) => {
                columns.set_item(&column.name, PyArray1::from_slice(py, values))?
            }
            Values::Integer(values) => {
                columns.set_item(&column.name, PyArray1::from_slice(py, values))?
            }
            Values::Count(values) => columns.set_item(
                &column.name,
                PyArray1::from_iter(py, values.iter().map(|value| *value as i64)),
            )?,
            Values::Flag(values) => {
                columns.set_item(&column.name, PyArray1::from_slice(py, values))?
            }
            Values::Text(values) => columns.set_item(&column.name, values)?,
        }
    }
    let manifest =
        serde_json::to_string(&table.1).map_err(|error| Failure::new("JounceError", error))?;
    Ok((columns, notes, manifest))
}
