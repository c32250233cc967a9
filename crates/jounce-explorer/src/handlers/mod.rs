//! Computation of the result of each kind of request.

pub(super) mod aperiodic_motion;
pub(super) mod band;
pub(super) mod basins;
pub(super) mod branch_points;
pub(super) mod design;
pub(super) mod design_search;
pub(super) mod ensemble;
pub(super) mod excitation;
pub(super) mod export;
pub(super) mod load;
pub(super) mod operating_point;
pub(super) mod orbit;
pub(super) mod progress;
pub(super) mod response;
pub(super) mod save;
pub(super) mod strain;
pub(super) mod sweep;
mod upload;
