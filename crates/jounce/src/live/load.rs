//! Mean power over the load: integrated points, and the closed form of the harvester without
//! contact.

use super::key_span::values;
use super::{Design, LinearCurve, LiveAnalysis, LivePoint};
use crate::error::Error;
use jounce_analysis::{Parameter, SweepOrder};
use jounce_control::Control;
use jounce_spec::NumericKey;
use serde::{Deserialize, Serialize};

/// Ratio of the ends of the range to the present load.
const RATIO: f64 = 100.0;
/// Number of points of the linear curve.
const LINEAR_POINTS: usize = 121;

/// Options of [`Design::load_sweep`] and [`LiveAnalysis::linear_load`]. The range goes from a
/// hundredth of the present load to its hundredfold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LoadOptions {
    /// Key of the resistance.
    pub over: String,
    /// Number of values.
    pub points: usize,
}

/// Mean power without contact over the range of a load sweep.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinearLoad {
    /// Key of the resistance.
    pub over: String,
    /// Its SI unit.
    pub unit: String,
    /// The curve.
    pub curve: LinearCurve,
}

impl Design {
    /// Integrates at values of the load in equal ratios, each from the start of the spec. `done`
    /// is called for each point as soon as it is integrated. Returns the number of points.
    ///
    /// # Errors
    /// As [`Design::sweep`].
    pub fn load_sweep(
        &self,
        options: &LoadOptions,
        control: &Control,
        done: &(dyn Fn(LivePoint) + Sync),
    ) -> Result<usize, Error> {
        let (key, ends) = self.load_range(options)?;
        let range = values(key, ends, options.points, "log")?;
        self.sweep_over(&range, SweepOrder::Independent, control, done)
    }

    /// Returns the key of the load and the ends of its range, SI.
    fn load_range(&self, options: &LoadOptions) -> Result<(NumericKey, (f64, f64)), Error> {
        let key = self.key(&options.over)?;
        let value = key.get(self.spec())?;
        let (low, high) = key.limits();
        Ok((key, ((value / RATIO).max(low), (value * RATIO).min(high))))
    }
}

impl LiveAnalysis {
    /// Computes the mean power without contact over the range of a load sweep.
    ///
    /// # Errors
    /// [`Error::Spec`] for an unknown key, [`Error::Analysis`] for a design without a model.
    pub fn linear_load(
        &self,
        design: &Design,
        options: &LoadOptions,
        control: &Control,
    ) -> Result<LinearLoad, Error> {
        let (key, (from, to)) = design.load_range(options)?;
        let base = self.model(design.spec(), control)?;
        let parameter = Parameter::new(&base, &key, to - from);
        let load = |k: usize| from * (to / from).powf(k as f64 / (LINEAR_POINTS - 1) as f64);
        let loads = (0..LINEAR_POINTS).map(load).collect();
        Ok(LinearLoad {
            over: options.over.clone(),
            unit: key.unit(),
            curve: LinearCurve::over(&parameter, loads),
        })
    }
}
