//! The fit as a least-squares problem.

use std::cell::{Cell, RefCell};

use jounce::spec::{NumericKey, Spec};
use jounce::structure;
use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use std::f64::consts::TAU;

use super::{Features, FitError};

/// A measured number: the mode's index, whether it is a frequency, its value and its relative deviation.
pub(super) struct Measured {
    pub mode: usize,
    pub is_frequency: bool,
    pub value: f64,
    pub deviation: f64,
}

/// Keys as `p0 exp(x)`; residuals of the features, then of the priors.
pub(super) struct Problem<'a> {
    pub spec: &'a Spec,
    pub hold: &'a [String],
    pub keys: Vec<NumericKey>,
    pub start: Vec<f64>,
    pub prior: Vec<f64>,
    pub measured: Vec<Measured>,
    pub unknowns: DVector<f64>,
    pub evaluations: Cell<usize>,
    /// Why the model could not be evaluated last.
    pub fault: RefCell<Option<FitError>>,
}

/// By how much the logarithm of a key is moved for a derivative: errors of the frequencies (1e-9) and of the quotient (1e-8) are alike.
const MOVED: f64 = 1e-4;

/// Every measured number of the features.
pub(super) fn measured(features: &Features) -> Vec<Measured> {
    let of = |mode: &super::ModeFeature| {
        let one = |is_frequency: bool, told: Option<(f64, f64)>| {
            told.map(|(value, deviation)| Measured { mode: mode.number - 1, is_frequency, value, deviation })
        };
        [one(true, mode.frequency), one(false, mode.damping_ratio)]
    };
    features.modes.iter().flat_map(of).flatten().collect()
}

impl Problem<'_> {
    /// The spec with these unknowns.
    pub fn changed(&self, unknowns: &DVector<f64>) -> Result<Spec, FitError> {
        let mut spec = self.spec.clone();
        for (k, key) in self.keys.iter().enumerate() {
            key.set(&mut spec, self.start[k] * unknowns[k].exp())?;
        }
        Ok(spec)
    }

    /// What the model has for every measured number.
    pub fn model(&self, unknowns: &DVector<f64>) -> Result<Vec<f64>, FitError> {
        self.evaluations.set(self.evaluations.get() + 1);
        let modes = structure::modes_holding(&self.changed(unknowns)?, self.hold)?;
        let value = |measured: &Measured| {
            if measured.mode >= modes.len() {
                return Err(FitError::NoMode { number: measured.mode + 1, modes: modes.len() });
            }
            let damping_ratio = modes.damping_ratio[measured.mode];
            match (measured.is_frequency, damping_ratio > 0.0) {
                (true, _) => Ok(modes.frequency_rad_s[measured.mode] / TAU),
                (false, true) => Ok(damping_ratio),
                (false, false) => Err(FitError::Undamped { number: measured.mode + 1, damping_ratio }),
            }
        };
        self.measured.iter().map(value).collect()
    }

    /// Errors over deviations: features first, then priors.
    pub fn errors(&self, unknowns: &DVector<f64>) -> Result<DVector<f64>, FitError> {
        let model = self.model(unknowns)?;
        let features = self.measured.iter().zip(&model).map(|(measured, model)| (model / measured.value).ln() / measured.deviation);
        let priors = unknowns.iter().zip(&self.prior).map(|(x, prior)| x / prior);
        Ok(DVector::from_iterator(model.len() + self.prior.len(), features.chain(priors)))
    }

    /// Derivatives of the errors.
    pub fn derivatives(&self) -> Result<DMatrix<f64>, FitError> {
        let column = |k: usize| {
            let moved = |by: f64| {
                let mut unknowns = self.unknowns.clone();
                unknowns[k] += by;
                self.errors(&unknowns)
            };
            Ok((moved(MOVED)? - moved(-MOVED)?) / (2.0 * MOVED))
        };
        Ok(DMatrix::from_columns(&(0..self.keys.len()).map(column).collect::<Result<Vec<_>, FitError>>()?))
    }

    fn kept<T>(&self, result: Result<T, FitError>) -> Option<T> {
        result.map_err(|fault| self.fault.replace(Some(fault))).ok()
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, unknowns: &DVector<f64>) {
        self.unknowns.copy_from(unknowns);
    }

    fn params(&self) -> DVector<f64> {
        self.unknowns.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.kept(self.errors(&self.unknowns))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.kept(self.derivatives())
    }
}
