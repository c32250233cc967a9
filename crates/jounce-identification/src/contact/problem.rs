//! Pulse fit as a least-squares problem.

use levenberg_marquardt::LeastSquaresProblem;
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::PulseShape;

/// Least-squares problem with the unknowns start (s), unit of time (s), force unit (N), exponent if
/// free, and damping, each scaled by its initial guess.
#[derive(Clone)]
pub(super) struct PulseProblem<'a> {
    pub time_s: &'a [f64],
    pub force_n: &'a [f64],
    /// Exponent, if fixed.
    pub exponent: Option<f64>,
    /// Scale of each unknown.
    pub scale: Vec<f64>,
    pub unknowns: DVector<f64>,
}

/// Relative step of an unknown for finite differences.
const DIFFERENCE_SHARE: f64 = 1e-4;
const EXPONENTS: (f64, f64) = (0.5, 5.0);
/// Below 0 the body would gain speed. Noise on a lossless contact needs this range, or the fit
/// would end at a bound.
const DAMPINGS: (f64, f64) = (-0.5, 20.0);

impl PulseProblem<'_> {
    /// Returns start, unit of time, unit of force, exponent, damping.
    pub fn parameters(&self, unknowns: &DVector<f64>) -> [f64; 5] {
        let value = |k: usize| unknowns[k] * self.scale[k];
        match self.exponent {
            Some(exponent) => [value(0), value(1), value(2), exponent, value(3)],
            None => [value(0), value(1), value(2), value(3), value(4)],
        }
    }

    pub fn errors(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let [start, unit_s, unit_n, exponent, damping] = self.parameters(unknowns);
        let shape = PulseShape::new(
            exponent.clamp(EXPONENTS.0, EXPONENTS.1),
            damping.clamp(DAMPINGS.0, DAMPINGS.1),
        );
        let model = |t: &f64| unit_n * shape.at((t - start) / unit_s);
        DVector::from_iterator(
            self.time_s.len(),
            self.time_s
                .iter()
                .zip(self.force_n)
                .map(|(t, f)| model(t) - f),
        )
    }

    pub fn derivatives(&self) -> DMatrix<f64> {
        let column = |k: usize| {
            let errors_at = |by: f64| {
                let mut unknowns = self.unknowns.clone();
                unknowns[k] += by;
                self.errors(&unknowns)
            };
            (errors_at(DIFFERENCE_SHARE) - errors_at(-DIFFERENCE_SHARE)) / (2.0 * DIFFERENCE_SHARE)
        };
        DMatrix::from_columns(&(0..self.unknowns.len()).map(column).collect::<Vec<_>>())
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for PulseProblem<'_> {
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
        Some(self.errors(&self.unknowns))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        Some(self.derivatives())
    }
}
