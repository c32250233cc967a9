//! Response without contact, stored as long as only stops change.

use jounce_analysis::Parameter;
use jounce_model::linear::steady_power_w;
use jounce_orbits::ParametricModel;
use jounce_spec::Spec;
use rayon::prelude::*;
use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of points of the curve.
const POINTS: usize = 161;

/// Mean power of the harvester without contact over a key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinearCurve {
    /// Values of the key, SI.
    pub parameter: Vec<f64>,
    /// Mean power of all loads, W; NaN where the key does not allow the value.
    pub mean_power_w: Vec<f64>,
}

impl LinearCurve {
    /// Computes the curve at values of a key.
    pub(in crate::live) fn over(parameter: &Parameter, values: Vec<f64>) -> Self {
        let power = |value: &f64| {
            parameter
                .at(*value)
                .map_or(f64::NAN, |setting| steady_power_w(&setting.kernel.plant))
        };
        Self {
            mean_power_w: values.par_iter().map(power).collect(),
            parameter: values,
        }
    }
}

/// A curve with its design.
#[derive(Debug)]
struct StoredLinear {
    /// Design without its stops.
    spec: Spec,
    key: String,
    range: (f64, f64),
    curve: LinearCurve,
}

/// Last curve.
#[derive(Debug, Default)]
pub struct LastLinear(Mutex<Option<Arc<StoredLinear>>>);

impl LastLinear {
    /// Returns a copy that curves stored later in one of both do not change.
    pub fn fork(&self) -> Self {
        let last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        Self(Mutex::new(last.clone()))
    }

    /// Returns the curve of a design over a key.
    pub fn curve(&self, design: &Spec, parameter: &Parameter, range: (f64, f64)) -> LinearCurve {
        let mut spec = design.clone();
        spec.stop.clear();
        let key = parameter.key().path().to_owned();
        // No lock is held while threads compute: one of them might request the same curve.
        let last = self
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        if let Some(last) =
            last.filter(|last| last.range == range && last.key == key && last.spec == spec)
        {
            return last.curve.clone();
        }
        let (low, high) = range;
        let value = |k: usize| low + (high - low) * k as f64 / (POINTS - 1) as f64;
        let curve = LinearCurve::over(parameter, (0..POINTS).map(value).collect());
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::new(StoredLinear {
            spec,
            key,
            range,
            curve: curve.clone(),
        }));
        curve
    }
}
