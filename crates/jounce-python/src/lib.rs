//! The Python module of jounce: it reads arguments, calls the library and returns arrays. It
//! computes nothing itself; the package that uses it is in `python/jounce`.

mod arrays;
mod basins;
mod bifurcations;
mod branch;
mod cancellable;
mod diagram;
mod ensemble;
mod examples;
mod explore;
mod failure;
mod fit;
mod flat;
mod frf;
mod history;
mod materials;
mod measured;
mod modes;
mod noise;
mod reproduce;
mod rig;
mod run;
mod signal;
mod spec;
mod starters;
mod study;
mod sweep;

/// The module seen from Python.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::basins::basins;
    #[pymodule_export]
    use super::bifurcations::bifurcations;
    #[pymodule_export]
    use super::branch::branch;
    #[pymodule_export]
    use super::diagram::diagram;
    #[pymodule_export]
    use super::ensemble::ensemble;
    #[pymodule_export]
    use super::examples::examples;
    #[pymodule_export]
    use super::explore::Explorer;
    #[pymodule_export]
    use super::fit::fit;
    #[pymodule_export]
    use super::frf::frf;
    #[pymodule_export]
    use super::materials::materials;
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
    use super::modes::modes;
    #[pymodule_export]
    use super::noise::noise;
    #[pymodule_export]
    use super::reproduce::reproduce;
    #[pymodule_export]
    use super::rig::rig;
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::signal::spectrum;
    #[pymodule_export]
    use super::spec::{Spec, keys, quantity_si, questions, schema};
    #[pymodule_export]
    use super::starters::{starter, starters};
    #[pymodule_export]
    use super::study::{Study, study_merge, study_status, table_read};
    #[pymodule_export]
    use super::sweep::sweep;

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
