//! A harvester that depends on a parameter.

use crate::march::{Drift, Kernel};

/// A harvester at one value of its parameter.
#[derive(Debug)]
pub struct Setting {
    /// Ready to be marched; its drive starts at the angle that belongs to time 0.
    pub kernel: Kernel,
    /// What the parameter changes, where that is known exactly.
    pub change: Option<Change>,
}

/// Derivatives with respect to the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Of the port and the contact force.
    pub drift: Drift,
    /// Of the steady state at time 0, block coordinates.
    pub steady: Vec<f64>,
    /// Of the drive period, relative to it.
    pub period_relative: f64,
}

/// Harvesters over one parameter.
pub trait Harvester: Sync {
    /// Why there is none at a value.
    type Error: std::error::Error;

    /// The harvester at a value of the parameter.
    ///
    /// # Errors
    /// A value that is not allowed.
    fn at(&self, parameter: f64) -> Result<Setting, Self::Error>;

    /// Length of a difference of the parameter, where the exact derivative is not known.
    fn difference(&self) -> f64;
}
