//! Fit as a least-squares problem.

use std::cell::{Cell, OnceCell, RefCell};
use std::path::Path;

use jounce_control::Control;
use jounce_spec::{NumericKey, Spec};
use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::measured::MeasuredNumber;
use super::observations::Observations;
use super::{FitError, FitModel};

/// Least-squares problem with keys `p0 exp(x)`; residuals of the features, then of the priors.
pub(super) struct FitProblem<'a> {
    pub spec: &'a Spec,
    pub folder: &'a Path,
    pub hold: &'a [String],
    pub keys: Vec<NumericKey>,
    pub start: Vec<f64>,
    pub prior: Vec<f64>,
    pub observations: &'a Observations,
    /// Standard deviation of each group.
    pub deviation: Vec<f64>,
    pub unknowns: DVector<f64>,
    pub evaluations: Cell<usize>,
    /// Counts the evaluations, and can cancel the fit.
    pub control: &'a Control,
    /// Error of the most recent failed evaluation.
    pub fault: RefCell<Option<FitError>>,
}

/// Step in the logarithm of a key for finite differences: errors of the frequencies (1e-9) and of
/// the quotient (1e-8) are balanced.
const LOG_DIFFERENCE: f64 = 1e-4;

impl FitProblem<'_> {
    /// Spec with these unknowns.
    pub fn changed(&self, unknowns: &DVector<f64>) -> Result<Spec, FitError> {
        let mut spec = self.spec.clone();
        for (k, key) in self.keys.iter().enumerate() {
            key.set(&mut spec, self.start[k] * unknowns[k].exp())?;
        }
        Ok(spec)
    }

    /// Computes the model's value for every measured number.
    pub fn model(&self, unknowns: &DVector<f64>) -> Result<Vec<f64>, FitError> {
        self.evaluations.set(self.evaluations.get() + 1);
        self.control.count();
        if self.control.is_stopped() {
            return Err(FitError::Stopped {
                evaluations: self.evaluations.get(),
            });
        }
        // Orbits have their own count; here only evaluations are counted.
        let (spec, control) = (self.changed(unknowns)?, self.control.apart());
        let model = FitModel {
            spec,
            hold: self.hold,
            folder: self.folder,
            control,
            base_model: OnceCell::new(),
        };
        let results = self
            .observations
            .feature_models
            .iter()
            .map(|feature_model| feature_model.predict(&model))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(results.concat())
    }

    /// Standard deviation of a measured number.
    pub fn deviation_of(&self, measured: &MeasuredNumber) -> f64 {
        self.deviation[measured.group]
    }

    /// Errors relative to deviations: features first, then priors.
    pub fn errors(&self, unknowns: &DVector<f64>) -> Result<DVector<f64>, FitError> {
        let model = self.model(unknowns)?;
        let features = self
            .observations
            .measured
            .iter()
            .zip(&model)
            .map(|(measured, model)| measured.error(*model) / self.deviation_of(measured));
        let priors = unknowns.iter().zip(&self.prior).map(|(x, prior)| x / prior);
        Ok(DVector::from_iterator(
            model.len() + self.prior.len(),
            features.chain(priors),
        ))
    }

    /// Derivatives of the errors.
    pub fn derivatives(&self) -> Result<DMatrix<f64>, FitError> {
        let column = |k: usize| {
            let errors_at = |by: f64| {
                let mut unknowns = self.unknowns.clone();
                unknowns[k] += by;
                self.errors(&unknowns)
            };
            Ok((errors_at(LOG_DIFFERENCE)? - errors_at(-LOG_DIFFERENCE)?) / (2.0 * LOG_DIFFERENCE))
        };
        Ok(DMatrix::from_columns(
            &(0..self.keys.len())
                .map(column)
                .collect::<Result<Vec<_>, FitError>>()?,
        ))
    }

    fn store_error<T>(&self, result: Result<T, FitError>) -> Option<T> {
        result.map_err(|fault| self.fault.replace(Some(fault))).ok()
    }
}

impl MeasuredNumber {
    /// Error of the model, not divided by the deviation.
    pub fn error(&self, model: f64) -> f64 {
        match self.scale {
            None => (model / self.value).ln(),
            Some(scale) => (model - self.value) / scale,
        }
    }

    /// Returns the number at a given error from another one.
    pub fn shifted(&self, from: f64, error: f64) -> f64 {
        match self.scale {
            None => from * error.exp(),
            Some(scale) => from + scale * error,
        }
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for FitProblem<'_> {
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
        self.store_error(self.errors(&self.unknowns))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        self.store_error(self.derivatives())
    }
}
