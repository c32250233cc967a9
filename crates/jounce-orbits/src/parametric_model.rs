//! Harvester that depends on a parameter.

use jounce_dynamics::{Kernel, ParameterSensitivity};

/// Harvester at one value of its parameter.
#[derive(Debug)]
pub struct ModelInstance {
    /// Kernel ready for integration; its drive starts at the angle that belongs to time 0.
    pub kernel: Kernel,
    /// Derivatives with respect to the parameter, where they are known exactly.
    pub change: Option<ParameterDerivatives>,
}

/// Derivatives with respect to the parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterDerivatives {
    /// Derivatives of the port and the contact force.
    pub drift: ParameterSensitivity,
    /// Derivative of the steady state at time 0, block coordinates.
    pub steady: Vec<f64>,
    /// Derivative of the drive period, relative to the period.
    pub period_relative: f64,
}

impl ParameterDerivatives {
    /// Returns the derivatives where nothing changes, for so many states.
    pub fn zero(states: usize) -> Self {
        Self {
            drift: ParameterSensitivity::default(),
            steady: vec![0.0; states],
            period_relative: 0.0,
        }
    }
}

/// Family of harvesters over one parameter.
pub trait ParametricModel: Sync {
    /// Error of building a harvester at a value.
    type Error: std::error::Error;

    /// Returns the harvester at a value of the parameter.
    ///
    /// # Errors
    /// The value is not allowed.
    fn at(&self, parameter: f64) -> Result<ModelInstance, Self::Error>;

    /// Returns the parameter step of a difference quotient, where the exact derivative is not
    /// known.
    fn difference(&self) -> f64;
}
