//! Errors of the experimental half; all inputs are built in, so each would be a defect of jounce.

use crate::ReproduceError;
use jounce_io::table::TableError;
use jounce_model::plant::PlantError;
use jounce_model::structure::StructureError;
use jounce_signal::SignalError;

use jounce_data::recording::NoChannel;
use jounce_experiment::fit::FitError;
use jounce_experiment::rig::RigError;
use jounce_experiment::segmentation::SegmentationError;
use jounce_experiment::solution::SolutionError;
use jounce_identification::modal::ModalError;
use jounce_identification::response::ResponseError;
use jounce_signal::spectral::SpectralError;

/// Error of the experimental half.
#[derive(Debug, thiserror::Error)]
pub enum ExperimentError {
    /// The paper's spec.
    #[error(transparent)]
    Reproduce(#[from] ReproduceError),
    /// The structure.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The rig.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// The solutions of the model.
    #[error(transparent)]
    Solution(#[from] SolutionError),
    /// A channel.
    #[error(transparent)]
    Channel(#[from] NoChannel),
    /// A signal.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// A spectrum.
    #[error(transparent)]
    Spectral(#[from] SpectralError),
    /// The responses of the hammer test.
    #[error(transparent)]
    Response(#[from] ResponseError),
    /// The modes.
    #[error(transparent)]
    Modal(#[from] ModalError),
    /// The segments of the record.
    #[error(transparent)]
    Segmentation(#[from] SegmentationError),
    /// The fit to Table 2.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A table.
    #[error(transparent)]
    Table(#[from] TableError),
}
