//! Response without contact, stored as long as only stops change.

use crate::frame::Frame;
use jounce_core::analysis::Parameter;
use jounce_core::linear::steady_power_w;
use jounce_core::orbit::ParametricModel;
use jounce_core::spec::Spec;
use rayon::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of points of the curve.
const POINTS: usize = 161;

/// Mean power over a key.
#[derive(Debug)]
pub struct Linear {
    /// Design without its stops.
    spec: Spec,
    key: String,
    range: (f64, f64),
    power_w: Vec<f64>,
}

/// Last curve.
#[derive(Debug, Default)]
pub struct LastLinear(Mutex<Option<Arc<Linear>>>);

impl LastLinear {
    /// Returns the curve of a design over a key.
    pub fn curve(&self, design: &Spec, parameter: &Parameter, range: (f64, f64)) -> Arc<Linear> {
        let mut spec = design.clone();
        spec.stop.clear();
        let key = parameter.key().path().to_owned();
        // No lock is held while threads compute: one of them might request the same curve.
        let last = self
            .0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        if let Some(curve) =
            last.filter(|curve| curve.range == range && curve.key == key && curve.spec == spec)
        {
            return curve;
        }
        let power = |k: usize| {
            parameter
                .at(parameter_value(range, k))
                .map_or(f64::NAN, |setting| steady_power_w(&setting.kernel.plant))
        };
        let power_w = (0..POINTS).into_par_iter().map(power).collect();
        let curve = Arc::new(Linear {
            spec,
            key,
            range,
            power_w,
        });
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&curve));
        curve
    }
}

fn parameter_value((low, high): (f64, f64), k: usize) -> f64 {
    low + (high - low) * k as f64 / (POINTS - 1) as f64
}

impl Linear {
    /// Adds the curve to a frame.
    pub fn put(&self, frame: &mut Frame) {
        frame
            .array(
                "linear.x",
                (0..POINTS).map(|k| parameter_value(self.range, k)),
            )
            .array("linear.power", self.power_w.iter().copied());
    }
}
