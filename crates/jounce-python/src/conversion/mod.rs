//! Conversion of results, errors and waiting between the library and Python.

pub mod arrays;
pub mod cancellable;
pub mod failure;
pub mod flat;
pub mod history;
