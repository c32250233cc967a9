//! Two numeric keys of a spec as a plane of harvesters.

use crate::orbit::{Harvester, Plane, Setting};
use crate::spec::NumericKey;
use crate::study::{Parameter, Prepared, StudyError};

/// Length of a difference, beside the range of a key.
const DIFFERENCE: f64 = 1e-6;

/// Harvesters over two keys.
#[derive(Debug)]
pub struct KeyPlane<'s> {
    /// The spec at its own values.
    pub base: &'s Prepared,
    /// First and second key.
    pub keys: [&'s NumericKey; 2],
    /// Widths of their ranges.
    pub widths: [f64; 2],
}

/// Harvesters over the first key, at one value of the second.
#[derive(Debug)]
pub struct KeyLine<'s> {
    /// The spec at that value.
    pub prepared: Prepared,
    key: &'s NumericKey,
    width: f64,
}

impl<'s> Plane for KeyPlane<'s> {
    type Line = KeyLine<'s>;

    fn line(&self, parameter_2: f64) -> Result<KeyLine<'s>, StudyError> {
        let mut spec = self.base.spec.clone();
        self.keys[1].set(&mut spec, parameter_2)?;
        Ok(KeyLine { prepared: self.base.changed(spec)?, key: self.keys[0], width: self.widths[0] })
    }

    fn differences(&self) -> [f64; 2] {
        self.widths.map(|width| DIFFERENCE * width)
    }
}

impl Harvester for KeyLine<'_> {
    type Error = StudyError;

    fn at(&self, parameter: f64) -> Result<Setting, StudyError> {
        Parameter::new(&self.prepared, self.key, self.width).at(parameter)
    }

    fn difference(&self) -> f64 {
        DIFFERENCE * self.width
    }
}
