//! Settings, records and results of a hammer or shaker test.

use crate::Samples;
use serde::Serialize;

use super::{Estimator, FrequencyResponse, Hit};

/// Settings for cutting and windowing the blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactSettings {
    /// Estimator, by the assumed noise.
    pub estimator: Estimator,
    /// Length of a block, s. Default for hits: the complete record if it contains one hit, else the
    /// shortest distance between hits. Default for a continuous force: an eighth of the shortest
    /// record, or all of it for a sweep.
    pub block_s: Option<f64>,
    /// Sets the force after the hit, which is noise, to zero.
    pub force_window: bool,
    /// Final value of an exponential window on force and responses, for responses that do not decay
    /// within the block.
    pub end_ratio: Option<f64>,
    /// Treats the force as a shaker's; by default only a continuous force of both signs is.
    pub shaker: bool,
}

impl Default for ImpactSettings {
    fn default() -> Self {
        Self {
            estimator: Estimator::H1,
            block_s: None,
            force_window: false,
            end_ratio: None,
            shaker: false,
        }
    }
}

/// Record of a hammer test: the force, and responses of equal length.
#[derive(Debug, Clone)]
pub struct ImpactRecord<'a> {
    /// Force of the hammer, compression positive.
    pub force: Samples<'a>,
    /// Responses.
    pub responses: Vec<Samples<'a>>,
}

/// Hit with its record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImpactHit {
    /// Index of the record, from 0.
    pub record: usize,
    /// Hit.
    #[serde(flatten)]
    pub hit: Hit,
    /// False where its block would extend beyond the record, so that it was left out.
    pub used: bool,
}

/// Responses of a hammer test.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactResponses {
    /// One response function for each response.
    pub responses: Vec<FrequencyResponse>,
    /// All detected hits; empty for a continuous force.
    pub hits: Vec<ImpactHit>,
    /// True for a sweep.
    pub is_sweep: bool,
    /// Length of a block, s.
    pub block_s: f64,
    /// Damping that the exponential window adds to every mode, 1/s: the damping ratio of a mode at
    /// `w` rad/s is too high by this over `w`.
    pub window_decay_per_s: f64,
}
