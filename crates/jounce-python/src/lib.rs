//! The Python module of jounce: it reads arguments, calls the library and returns arrays. It
//! computes nothing itself; the package that uses it is in `python/jounce`.

mod conversion;
mod explore;
mod input;
mod measured;
mod questions;
mod signal;

/// The module seen from Python.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::explore::Explorer;
    #[pymodule_export]
    use super::input::examples::examples;
    #[pymodule_export]
    use super::input::materials::{chips, materials};
    #[pymodule_export]
    use super::input::spec::{Spec, is_unit, keys, quantities_si, quantity_si, questions, schema};
    #[pymodule_export]
    use super::input::starters::{starter, starters};
    #[pymodule_export]
    use super::measured::contact::contact;
    #[pymodule_export]
    use super::measured::frf::measured_frf;
    #[pymodule_export]
    use super::measured::modes::measured_modes;
    #[pymodule_export]
    use super::measured::power::power;
    #[pymodule_export]
    use super::measured::recording::{
        recording_even, recording_from_arrays, recording_read, recording_write,
    };
    #[pymodule_export]
    use super::measured::segments::segments;
    #[pymodule_export]
    use super::measured::spectra::spectra;
    #[pymodule_export]
    use super::questions::basins::basins;
    #[pymodule_export]
    use super::questions::bifurcations::bifurcations;
    #[pymodule_export]
    use super::questions::branch::branch;
    #[pymodule_export]
    use super::questions::cite::cite;
    #[pymodule_export]
    use super::questions::design::design;
    #[pymodule_export]
    use super::questions::diagram::diagram;
    #[pymodule_export]
    use super::questions::ensemble::ensemble;
    #[pymodule_export]
    use super::questions::exchange::{export, import_matrices, reduce_matrices};
    #[pymodule_export]
    use super::questions::fit::fit;
    #[pymodule_export]
    use super::questions::frf::frf;
    #[pymodule_export]
    use super::questions::modes::modes;
    #[pymodule_export]
    use super::questions::noise::noise;
    #[pymodule_export]
    use super::questions::reproduce::reproduce;
    #[pymodule_export]
    use super::questions::restitution::restitution;
    #[pymodule_export]
    use super::questions::rig::rig;
    #[pymodule_export]
    use super::questions::run::run;
    #[pymodule_export]
    use super::questions::sensitivity::sensitivity;
    #[pymodule_export]
    use super::questions::study::{Study, study_merge, study_status, table_read};
    #[pymodule_export]
    use super::questions::sweep::sweep;
    #[pymodule_export]
    use super::signal::spectrum;

    /// Loads the interface of numpy. If the first array of a result loaded it, a pending Ctrl-C
    /// could make that fail.
    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        let _ = numpy::PyArray1::<f64>::zeros(module.py(), 0, false);
        Ok(())
    }

    /// Version of the library.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
