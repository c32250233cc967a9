//! Maximum-likelihood fit of the modal model, with the covariance of its poles.
mod covariance;
mod design_matrix;
mod fit_data;
mod likelihood;
mod line_selection;
mod noise;
mod reference_model;
mod references;
mod scatter;
mod semi_normal;
mod variable_projection;

pub(super) use likelihood::{ModalFit, fit};
pub(super) use noise::variance;
pub(super) use references::fit_shared;
