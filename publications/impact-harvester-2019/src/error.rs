//! Errors of a reproduction.

use jounce_analysis::AnalysisError;
use jounce_analysis::run::RunError;
use jounce_io::store::StoreError;
use jounce_io::table::TableError;
use jounce_model::plant::PlantError;
use jounce_model::structure::StructureError;
use jounce_orbits::OrbitError;
use jounce_plot::PictureError;
use jounce_signal::SignalError;
use jounce_spec::{Fault, Faults};
use std::path::PathBuf;

/// Error of a reproduction. The inputs are built in, so the user can resolve only
/// [`ReproduceError::Folder`] and [`ReproduceError::Store`]; any other error is a defect of jounce.
#[derive(Debug, thiserror::Error)]
pub enum ReproduceError {
    /// See [`Faults`].
    #[error(transparent)]
    Spec(#[from] Faults),
    /// See [`StructureError`].
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// See [`PlantError`].
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// See [`RunError`].
    #[error(transparent)]
    Run(#[from] RunError),
    /// See [`SignalError`].
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// See [`TableError`].
    #[error(transparent)]
    Table(#[from] TableError),
    /// See [`PictureError`].
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// See [`StoreError`].
    #[error(transparent)]
    Store(#[from] StoreError),
    /// See [`AnalysisError`].
    #[error(transparent)]
    Study(#[from] AnalysisError),
    /// See [`OrbitError`].
    #[error(transparent)]
    Orbit(#[from] OrbitError<AnalysisError>),
    /// The output folder cannot be created.
    #[error("{}", jounce_io::store::unwritable_folder(path, reason))]
    Folder {
        /// Path of the folder.
        path: PathBuf,
        /// Reason of the failure.
        reason: String,
    },
}

impl From<Fault> for ReproduceError {
    fn from(fault: Fault) -> Self {
        Self::Spec(fault.into())
    }
}
