//! Errors of the experimental half; all inputs are built in, so each would be a defect of jounce.

use jounce_core::plant::PlantError;
use jounce_core::reproduce::ReproduceError;
use jounce_core::signal::SignalError;
use jounce_core::structure::StructureError;
use jounce_core::table::TableError;

use crate::fit::FitError;
use crate::modal::ModalError;
use crate::response::ResponseError;
use crate::rig::RigError;
use crate::segmentation::SegmentationError;
use crate::solution::SolutionError;
use crate::spectral::SpectralError;
use jounce_data::recording::NoChannel;

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
    Regime(#[from] SegmentationError),
    /// The fit to Table 2.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A table.
    #[error(transparent)]
    Table(#[from] TableError),
}
