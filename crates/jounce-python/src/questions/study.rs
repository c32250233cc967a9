//! Studies in parts.

use super::run::PythonResult;
use crate::conversion::arrays::PythonDict;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::Values;
use jounce::{Error, StudyFolder, StudyOptions, Table};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;

/// Study that is read and checked.
#[pyclass(frozen, module = "jounce._core")]
pub struct Study(jounce::Study);

#[pymethods]
impl Study {
    /// Reads a study of a spec from the text of its variation.
    #[new]
    fn new(spec: &Spec, text: &str) -> Result<Self, Failure> {
        Ok(Self(spec.harvester.study(text)?))
    }

    /// Returns the SHA-256 of all inputs of the table.
    fn hash_hex(&self) -> &str {
        self.0.hash_hex()
    }

    /// Returns the number of points.
    fn points(&self) -> usize {
        self.0.points()
    }

    /// Returns the number of parts.
    fn parts(&self) -> usize {
        self.0.parts()
    }

    /// Returns the number of points of a part.
    fn points_of(&self, part: usize) -> usize {
        self.0.points_of(part)
    }

    /// Returns the values of the keys at a point, SI.
    fn point(&self, index: usize) -> Result<Vec<f64>, Failure> {
        Ok(self.0.point(index)?)
    }

    /// Returns a part as the bytes of its file, computed on one thread.
    fn part<'py>(&self, py: Python<'py>, part: usize) -> PythonResult<'py> {
        let outcome = cancellable(py, None, |control| {
            let bytes = self.0.with_control(control).part(part)?;
            Ok((bytes, control.wall_time_s()))
        });
        to_python_result(py, outcome, |(bytes, wall_time_s)| {
            Ok(PythonDict::new(py)
                .with("bytes", PyBytes::new(py, &bytes))?
                .with("wall_time_s", wall_time_s)?
                .dict())
        })
    }

    /// Computes the missing parts of a shard of the study in a folder and merges complete parts;
    /// `options` are the fields of the options of the library, as JSON.
    fn run<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
        options: &str,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PythonResult<'py> {
        let options: StudyOptions = flat::options(options)?;
        let outcome = cancellable(py, progress.as_ref(), |control| {
            self.0.with_control(control).run(&folder, &options)?;
            Ok(control.wall_time_s())
        });
        to_python_result(py, outcome, |wall_time_s| {
            Ok(PythonDict::new(py).with("wall_time_s", wall_time_s)?.dict())
        })
    }

    /// Returns the numbers of the parts of a shard that a folder lacks; a missing folder is created.
    fn missing(&self, py: Python<'_>, folder: PathBuf, options: &str) -> PyResult<Vec<usize>> {
        let options: StudyOptions = flat::options(options)?;
        detach(py, || self.0.missing(&folder, options.shard))
    }

    /// Stores a part that was computed elsewhere.
    fn keep(&self, py: Python<'_>, folder: PathBuf, part: usize, bytes: &[u8]) -> PyResult<()> {
        detach(py, || self.0.keep(&folder, part, bytes))
    }
}

/// Runs work without the lock of the interpreter.
fn detach<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T, Error> + Send) -> PyResult<T> {
    py.detach(work)
        .map_err(|error| Failure::from(error).into_exception(py))
}

/// Joins the parts of a folder into one table and returns its path.
#[pyfunction]
pub fn study_merge(py: Python<'_>, folder: PathBuf) -> PyResult<PathBuf> {
    detach(py, || Ok(StudyFolder::open(&folder)?.merge()?))
}

/// Returns the progress of the study in a folder, as JSON.
#[pyfunction]
pub fn study_status(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    let status = detach(py, || Ok(StudyFolder::open(&folder)?.status()))?;
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
        .map_err(|error| Failure::from(Error::from(error)).into_exception(py))?;
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
