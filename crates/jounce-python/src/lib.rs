//! The Python module of jounce: arguments in, library calls, arrays out. It computes nothing itself; the package around it is in `python/jounce`.

mod arrays;
mod basins;
mod branch;
mod diagram;
mod driven;
mod ensemble;
mod examples;
mod failure;
mod frf;
mod history;
mod jumps;
mod materials;
mod modes;
mod run;
mod signal;
mod spec;
mod study;
mod sweep;
mod watched;

/// The module as Python sees it.
#[pyo3::pymodule]
mod _core {
    #[pymodule_export]
    use super::basins::basins;
    #[pymodule_export]
    use super::branch::branch;
    #[pymodule_export]
    use super::diagram::diagram;
    #[pymodule_export]
    use super::ensemble::ensemble;
    #[pymodule_export]
    use super::examples::examples;
    #[pymodule_export]
    use super::frf::frf;
    #[pymodule_export]
    use super::jumps::jumps;
    #[pymodule_export]
    use super::materials::materials;
    #[pymodule_export]
    use super::modes::modes;
    #[pymodule_export]
    use super::run::run;
    #[pymodule_export]
    use super::signal::spectrum;
    #[pymodule_export]
    use super::spec::{Spec, quantity_si};
    #[pymodule_export]
    use super::study::{Study, study_merge, study_status, table_read};
    #[pymodule_export]
    use super::sweep::sweep;

    /// Version of the library.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
