//! Conversion of rows of numbers to arrays of numpy; a list is moved, not copied.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Result for Python: arrays and values by name.
pub struct PythonDict<'py>(Bound<'py, PyDict>);

impl<'py> PythonDict<'py> {
    /// Returns an empty dictionary.
    pub fn new(py: Python<'py>) -> Self {
        Self(PyDict::new(py))
    }

    /// Adds a value.
    pub fn with(self, name: &str, value: impl IntoPyObject<'py>) -> PyResult<Self> {
        self.0.set_item(name, value)?;
        Ok(self)
    }

    /// Adds an array of one axis.
    pub fn array<T: numpy::Element>(self, name: &str, values: Vec<T>) -> PyResult<Self> {
        let array = PyArray1::from_vec(self.0.py(), values);
        self.with(name, array)
    }

    /// Adds an array of one axis, with a value per item.
    pub fn each<I, T: numpy::Element>(
        self,
        name: &str,
        items: &[I],
        value: impl Fn(&I) -> T,
    ) -> PyResult<Self> {
        self.array(name, items.iter().map(value).collect())
    }

    /// Adds an array of two axes, with `rows` of a width along the first.
    pub fn rows(self, name: &str, rows: &[Vec<f64>], width: usize) -> PyResult<Self> {
        let array = matrix(self.0.py(), rows, width)?;
        self.with(name, array)
    }

    /// Returns the dictionary.
    pub fn dict(self) -> Bound<'py, PyDict> {
        self.0
    }
}

/// Converts rows of a width to an array of two axes; there may be no row.
pub fn matrix<'py>(
    py: Python<'py>,
    rows: &[Vec<f64>],
    width: usize,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_vec(py, rows.concat()).reshape([rows.len(), width])
}
