//! Family of models over the plane of two numeric keys of a spec.

use crate::{AnalysisError, Model, Parameter};
use jounce_orbits::{ModelInstance, ParametricModel, TwoParameterProblem};
use jounce_spec::NumericKey;

/// Step of a difference, relative to the range of a key or, where smaller, its value. The condition
/// of a fold is a thousand times less accurate than the orbit: with a tenth of this step, at
/// tolerance 1e-9, noise spoils the slope and Newton stalls.
const DIFFERENCE_STEP: f64 = 1e-5;

/// Step of a difference of the residual only, relative to the range of the key.
const RESIDUAL_DIFFERENCE_STEP: f64 = 1e-6;

/// Smallest value, relative to the range, that serves as a scale.
const MIN_OWN_LENGTH: f64 = 1e-3;

/// Family of models over two keys.
#[derive(Debug)]
pub struct KeyPlane<'s> {
    /// Model of the spec, unchanged.
    pub base: &'s Model,
    /// First and second key.
    pub keys: [&'s NumericKey; 2],
    /// Widths of the ranges.
    pub widths: [f64; 2],
}

/// Family of models over the first key at one value of the second.
#[derive(Debug)]
pub struct KeyLine<'s> {
    /// Model at that value.
    pub model: Model,
    key: &'s NumericKey,
    width: f64,
}

impl<'s> TwoParameterProblem for KeyPlane<'s> {
    type Line = KeyLine<'s>;

    fn line(&self, parameter_2: f64) -> Result<KeyLine<'s>, AnalysisError> {
        let mut spec = self.base.spec.clone();
        self.keys[1].set(&mut spec, parameter_2)?;
        Ok(KeyLine {
            model: self.base.changed(spec)?,
            key: self.keys[0],
            width: self.widths[0],
        })
    }

    fn differences(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| difference(at[k], self.widths[k]))
    }
}

impl ParametricModel for KeyLine<'_> {
    type Error = AnalysisError;

    fn at(&self, parameter: f64) -> Result<ModelInstance, AnalysisError> {
        Parameter::new(&self.model, self.key, self.width).at(parameter)
    }

    fn difference(&self) -> f64 {
        RESIDUAL_DIFFERENCE_STEP * self.width
    }
}

fn difference(value: f64, width: f64) -> f64 {
    DIFFERENCE_STEP * width.min(value.abs().max(MIN_OWN_LENGTH * width))
}
