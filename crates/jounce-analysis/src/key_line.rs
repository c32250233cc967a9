//! Models on a straight line in the space of several keys.

use super::parameter::check_periodic;
use super::{AnalysisError, Model};
use jounce_orbits::{ModelInstance, ParameterDerivatives, ParametricModel};
use jounce_spec::NumericKey;

/// Step of a difference quotient along the line, relative to its length.
const DIFFERENCE: f64 = 1e-7;

/// Family of models: at 0 the model of a spec, at 1 that of the same spec with other values of
/// some keys, and linear between the two.
#[derive(Debug)]
pub struct KeyLine<'s> {
    /// Model at 0.
    pub base: &'s Model,
    /// Keys with their values at 0 and at 1, SI.
    pub ends: Vec<(&'s NumericKey, [f64; 2])>,
}

impl<'s> KeyLine<'s> {
    /// Returns the line without length: every value of the parameter gives the same model.
    pub fn at(base: &'s Model) -> Self {
        let ends = Vec::new();
        Self { base, ends }
    }

    /// Returns the model at a place.
    ///
    /// # Errors
    /// A value that the spec does not allow, and as [`Model::new`].
    pub fn model(&self, place: f64) -> Result<Model, AnalysisError> {
        let mut spec = self.base.spec.clone();
        let value = |(key, [from, to]): &(&'s NumericKey, [f64; 2])| match place {
            0.0 => (*key, *from),
            1.0 => (*key, *to),
            _ => (*key, from + place * (to - from)),
        };
        let values: Vec<(&NumericKey, f64)> = self.ends.iter().map(value).collect();
        NumericKey::set_all(&mut spec, &values)?;
        self.base.changed(spec)
    }
}

impl ParametricModel for KeyLine<'_> {
    type Error = AnalysisError;

    fn at(&self, place: f64) -> Result<ModelInstance, AnalysisError> {
        self.base.kernel.control.count_harvester();
        let kernel = self.model(place)?.kernel;
        check_periodic(&kernel)?;
        let is_constant = self.ends.is_empty();
        let change = is_constant.then(|| ParameterDerivatives::zero(kernel.plant.len()));
        Ok(ModelInstance { kernel, change })
    }

    fn difference(&self) -> f64 {
        DIFFERENCE
    }
}
