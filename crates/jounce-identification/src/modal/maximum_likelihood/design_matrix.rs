//! Columns of the modal model at the lines of a band.
//!
//! A pole `p` contributes `(p / j w)^m G(j w - p)` to a line. The powers, and `exp(-s T)` for `s =
//! j w - p` in `G`, are products of a number of the line and one of the pole, so no term needs its
//! own exponential.

use jounce_linalg::{Mat, c64};

use jounce_signal::spectral::WindowBias;

/// Properties of the terms of a band: window bias, power `m`, number of terms for the modes above
/// the band.
pub(super) type TermKind = (WindowBias, i32, usize);

/// Line or pole: `j w` or `p`, its factors of `exp(-s T)` and of the factor before `G`.
#[derive(Clone, Copy)]
struct TermPoint {
    at: c64,
    end: c64,
    factor: c64,
}

impl TermPoint {
    fn of_line((window_bias, power, _): TermKind, w: f64) -> Self {
        let at = c64::new(0.0, w);
        Self {
            at,
            end: window_bias.end(at),
            factor: at.powi(-power),
        }
    }

    fn of_pole((window_bias, power, _): TermKind, at: c64) -> Self {
        Self {
            at,
            end: window_bias.end(-at),
            factor: at.powi(power),
        }
    }

    fn conj(self) -> Self {
        Self {
            at: self.at.conj(),
            end: self.end.conj(),
            factor: self.factor.conj(),
        }
    }

    /// Returns `(p / j w)^m G(j w - p)` and its derivative by `p`, at this line.
    fn pole_term((window_bias, power, _): TermKind, line: Self, pole: Self) -> (c64, c64) {
        let (value, slope) = window_bias.transform_from(line.at - pole.at, line.end * pole.end);
        let factor = line.factor * pole.factor;
        match power {
            0 => (value, -slope),
            _ => (
                factor * value,
                factor * (f64::from(power) * value / pole.at - slope),
            ),
        }
    }

    /// Combines the terms of a pole and its conjugate for the real and the imaginary part of their
    /// coefficient: values, derivatives.
    fn pair_terms(kind: TermKind, line: Self, pole: Self) -> ([c64; 2], [c64; 2]) {
        let (one, two) = (
            Self::pole_term(kind, line, pole),
            Self::pole_term(kind, line, pole.conj()),
        );
        let real_columns = |one: c64, two: c64| [one + two, c64::new(0.0, 1.0) * (one - two)];
        (real_columns(one.0, two.0), real_columns(one.1, two.1))
    }
}

/// Values of the linear terms at lines: real and imaginary part of each residue, then of `-1/w^2`
/// and of `1, w^2, ..`. The block's share of the decay of a mode, `p^m R exp(p t)` for the power
/// `m`, is displacement per force over `(j w)^m`.
pub(super) struct LinearTerms {
    kind: TermKind,
    poles: Vec<TermPoint>,
}

impl LinearTerms {
    pub fn of(kind: TermKind, poles: &[c64]) -> Self {
        Self {
            kind,
            poles: poles.iter().map(|p| TermPoint::of_pole(kind, *p)).collect(),
        }
    }

    /// Sum of the terms times their unknowns at a line.
    pub fn sum(&self, w: f64, unknown: impl Iterator<Item = f64>) -> c64 {
        let line = TermPoint::of_line(self.kind, w);
        let terms = self
            .poles
            .iter()
            .flat_map(|pole| TermPoint::pair_terms(self.kind, line, *pole).0)
            .chain(residuals(w, self.kind.2));
        terms.zip(unknown).map(|(term, x)| term * x).sum()
    }
}

/// Residual terms of the modes below and above the band.
fn residuals(w: f64, upper: usize) -> impl Iterator<Item = c64> {
    let upper_terms = std::iter::successors(Some(1.0), move |x| Some(x * (w * w))).take(upper);
    std::iter::once(-1.0 / (w * w))
        .chain(upper_terms)
        .flat_map(|x| [c64::new(x, 0.0), c64::new(0.0, x)])
}

/// Unweighted columns at some poles, shared by all responses: two rows per line, real and imaginary
/// part.
pub(super) struct DesignMatrix {
    /// Columns of the linear unknowns.
    pub linear: Mat<f64>,
    /// For each pole `u + u'` and `j (u - u')`, where `u` is the derivative of its term by the
    /// pole, `1 / (j w - p)^2` without window bias, and `u'` the derivative for the conjugate pole.
    pub derivatives: Mat<f64>,
}

impl DesignMatrix {
    /// Returns the matrices of each power.
    pub fn of_kinds(
        window_bias: WindowBias,
        powers: &[i32],
        angular: &[f64],
        poles: &[c64],
        upper: usize,
    ) -> Vec<Self> {
        powers
            .iter()
            .map(|power| Self::of((window_bias, *power, upper), angular, poles))
            .collect()
    }

    fn of(kind: TermKind, angular: &[f64], poles: &[c64]) -> Self {
        let (rows, modes) = (2 * angular.len(), 2 * poles.len());
        let (mut linear, mut derivatives) = (
            Mat::<f64>::zeros(rows, modes + 2 + 2 * kind.2),
            Mat::<f64>::zeros(rows, modes),
        );
        let lines: Vec<TermPoint> = angular
            .iter()
            .map(|w| TermPoint::of_line(kind, *w))
            .collect();
        for (r, p) in poles.iter().enumerate() {
            let pole = TermPoint::of_pole(kind, *p);
            for (k, line) in lines.iter().enumerate() {
                let (values, slopes) = TermPoint::pair_terms(kind, *line, pole);
                for c in 0..2 {
                    (linear[(2 * k, 2 * r + c)], linear[(2 * k + 1, 2 * r + c)]) =
                        (values[c].re, values[c].im);
                    (
                        derivatives[(2 * k, 2 * r + c)],
                        derivatives[(2 * k + 1, 2 * r + c)],
                    ) = (slopes[c].re, slopes[c].im);
                }
            }
        }
        for (k, w) in angular.iter().enumerate() {
            for (c, value) in residuals(*w, kind.2).enumerate() {
                (linear[(2 * k, modes + c)], linear[(2 * k + 1, modes + c)]) = (value.re, value.im);
            }
        }
        Self {
            linear,
            derivatives,
        }
    }
}
