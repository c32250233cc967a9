//! `[stop.NAME]`

use super::ContactBodies;
use crate::ForceCurve;

/// A stop that a point strikes.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// `at`: the striking point, `"beam.tip"`, `"table"`, `"harvester.tip"`.
    pub at: String,
    /// `frame`: `"ground"` (default), another base, or the body or point that carries the stop and
    /// takes the reaction.
    pub frame: String,
    /// `side`: `"positive"` (default) or `"negative"`: direction in which the point moves to
    /// strike.
    pub side: Side,
    /// `gap`, m; may be negative (preloaded contact).
    pub gap_m: f64,
    /// `law` and its numbers.
    pub law: StopLaw,
    /// `radius` and the other keys of the two bodies, from which the stiffness of the law follows;
    /// `None` where `stiffness` is given.
    pub bodies: Option<ContactBodies>,
    /// `penetration_m` and `force_n`, `penetration` and `force`, or `file`: the points of the law
    /// `table`; empty for other laws.
    pub table: ForceTable,
}

/// Measured force over penetration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ForceTable {
    /// `penetration_m`, m, ascending; a first point at 0 may be omitted.
    pub penetration_m: Vec<f64>,
    /// `force_n`, N, one for each penetration.
    pub force_n: Vec<f64>,
    /// `file`: file with the points, relative to the spec; empty once the points are read.
    pub file: String,
}

impl ForceTable {
    /// Returns the monotone curve through the points; `None` if they are no force law, see
    /// [`ForceCurve::through`].
    pub fn curve(&self) -> Option<ForceCurve> {
        let begins_at_origin =
            self.penetration_m.first() == Some(&0.0) && self.force_n.first() == Some(&0.0);
        let first = usize::from(begins_at_origin);
        ForceCurve::through(&self.penetration_m[first..], &self.force_n[first..])
    }
}

/// Side of the stop relative to the point at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// Struck by moving in the positive direction.
    #[default]
    Positive,
    /// Struck by moving in the negative direction.
    Negative,
}

/// The contact law of a stop. `delta` is the penetration, m; `delta'` its rate, m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StopLaw {
    /// `law = "hertz"`: `F = stiffness * delta^exponent`; keys `stiffness` (N/m^exponent),
    /// `exponent` (default 1.5, at least 1).
    Hertz {
        /// N/m^exponent
        stiffness: f64,
        /// dimensionless
        exponent: f64,
    },
    /// `law = "spring"`: `F = stiffness * delta`; key `stiffness` (N/m).
    Spring {
        /// N/m
        stiffness_n_m: f64,
    },
    /// `law = "kelvin-voigt"`: `F = max(0, stiffness * delta + damping * delta')`; keys `stiffness`
    /// (N/m), `damping` (N s/m).
    KelvinVoigt {
        /// N/m
        stiffness_n_m: f64,
        /// N s/m
        damping_n_s_m: f64,
    },
    /// `law = "hunt-crossley"`: `F = stiffness * delta^exponent * max(0, 1 + damping * delta')`;
    /// keys `stiffness`, `exponent`, `damping` (s/m).
    HuntCrossley {
        /// N/m^exponent
        stiffness: f64,
        /// dimensionless
        exponent: f64,
        /// s/m
        damping_s_m: f64,
    },
    /// `law = "cubic"`: `F = stiffness * delta + cubic_stiffness * delta^3` on both sides of the
    /// rest position, with either sign; keys `stiffness` (N/m, default 0), `cubic_stiffness`
    /// (N/m^3).
    Cubic {
        /// N/m
        stiffness_n_m: f64,
        /// N/m^3
        cubic_stiffness_n_m3: f64,
    },
    /// `law = "table"`: `F = f(delta) * max(0, 1 + damping * delta')` with a monotone curve `f`
    /// through the points of [`Stop::table`]; keys `penetration_m` and `force_n`, `penetration` and
    /// `force`, or `file`; `damping` (s/m, default 0).
    Table {
        /// s/m
        damping_s_m: f64,
    },
    /// `law = "rigid"`: instantaneous rebound with a coefficient of restitution; key `restitution`
    /// (0 to 1).
    Rigid {
        /// dimensionless
        restitution: f64,
    },
}

impl Stop {
    /// Returns the static penetration of a one-sided stop under a force, m: `(F / stiffness)^(1 /
    /// exponent)`, 0 for a rigid stop; `None` for a two-sided stop, and for a faulty table.
    pub fn static_penetration_m(&self, force_n: f64) -> Option<f64> {
        match self.law {
            StopLaw::Hertz {
                stiffness,
                exponent,
            }
            | StopLaw::HuntCrossley {
                stiffness,
                exponent,
                ..
            } => Some((force_n / stiffness).powf(exponent.recip())),
            StopLaw::Spring { stiffness_n_m } | StopLaw::KelvinVoigt { stiffness_n_m, .. } => {
                Some(force_n / stiffness_n_m)
            }
            StopLaw::Cubic { .. } => None,
            StopLaw::Table { .. } => self.table.curve().map(|curve| curve.penetration_m(force_n)),
            StopLaw::Rigid { .. } => Some(0.0),
        }
    }
}
