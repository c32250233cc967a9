//! Export of a model, and import of structures as matrices.

use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::{MatrixEntries, MatrixSet, NameKind, Names};
use jounce::{Error, ExportOptions, ImportOptions, ImportResult};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// Entries of a matrix; others are zero, and entries at the same place are summed.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct MatrixInput<'py> {
    name: String,
    rows: usize,
    columns: usize,
    row: PyReadonlyArray1<'py, i64>,
    column: PyReadonlyArray1<'py, i64>,
    value: PyReadonlyArray1<'py, f64>,
}

impl MatrixInput<'_> {
    fn entries(&self) -> MatrixEntries {
        // A negative index becomes one outside, which the library refuses.
        let index = |value: &i64| usize::try_from(*value).unwrap_or(usize::MAX);
        let [row, column] = [&self.row, &self.column].map(|indices| indices.as_array());
        let value = self.value.as_array();
        let places = row.iter().map(index).zip(column.iter().map(index));
        let entries = places.zip(value);
        MatrixEntries {
            rows: self.rows,
            columns: self.columns,
            entries: entries.map(|((i, j), x)| (i, j, *x)).collect(),
        }
    }
}

/// Writes a model as matrices, as a circuit, or both, and returns the files; `options` are the fields
/// of the options of the library, as JSON.
#[pyfunction]
pub fn export(py: Python<'_>, spec: &Spec, options: &str) -> PyResult<Vec<PathBuf>> {
    let options: ExportOptions = flat::options(options)?;
    let result = py.detach(|| spec.harvester.export(&options));
    Ok(result
        .map_err(|error| Failure::from(error).into_exception(py))?
        .files)
}

/// Reduces the matrices of a folder to modes; `options` are the fields of the options of the library,
/// as JSON.
#[pyfunction]
pub fn import_matrices<'py>(
    py: Python<'py>,
    folder: PathBuf,
    options: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let options: ImportOptions = flat::options(options)?;
    let result = py.detach(|| jounce::import_matrices(&folder, &options));
    into_python(py, result)
}

/// Reduces matrices in memory to modes; `points` and `electrodes` are the names of the rows of
/// `points` and of the columns of `coupling`.
#[pyfunction]
pub fn reduce_matrices<'py>(
    py: Python<'py>,
    matrices: Vec<MatrixInput<'py>>,
    points: Vec<String>,
    electrodes: Vec<String>,
    options: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let options: ImportOptions = flat::options(options)?;
    let mut names = Names::default();
    names.add(NameKind::Point, &points);
    names.add(NameKind::Electrode, &electrodes);
    let matrix = |input: &MatrixInput<'py>| (input.name.clone(), input.entries());
    let set = MatrixSet {
        matrix: matrices.iter().map(matrix).collect(),
        names,
    };
    let result = py.detach(|| jounce::reduce_matrices(set, &options));
    into_python(py, result)
}

fn into_python<'py>(
    py: Python<'py>,
    result: Result<ImportResult, Error>,
) -> PyResult<Bound<'py, PyDict>> {
    let result = result.map_err(|error| Failure::from(error).into_exception(py))?;
    let dict = flat::dict_with_main(py, &result, "modes")?;
    Ok(dict.with("warnings", &result.warnings)?.dict())
}
