//! A harvester that depends on a parameter.

use crate::integrate::{Kernel, ParameterSensitivity};

/// A harvester at one value of its parameter.
#[derive(Debug)]
pub struct ModelInstance {
    /// Ready to be marched; its drive starts at the angle that belongs to time 0.
    pub kernel: Kernel,
    /// What the parameter changes, where that is known exactly.
    pub change: Option<ParameterDerivatives>,
}

/// Derivatives with respect to the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterDerivatives {
    /// Of the port and the contact force.
    pub drift: ParameterSensitivity,
    /// Of the steady state at time 0, block coordinates.
    pub steady: Vec<f64>,
    /// Of the drive period, relative to it.
    pub period_relative: f64,
}

/// Harvesters over one parameter.
pub trait ParametricModel: Sync {
    /// Why there is none at a value.
    type Error: std::error::Error;

    /// The harvester at a value of the parameter.
    ///
    /// # Errors
    /// A value that is not allowed.
    fn at(&self, parameter: f64) -> Result<ModelInstance, Self::Error>;

    /// Length of a difference of the parameter, where the exact derivative is not known.
    fn difference(&self) -> f64;
}
