//! Points on one line of the plane from which curves start.

use super::{BifurcationCurve, BifurcationCurvePoint, CurveKind};
use crate::bandwidth::{CurvePiece, PieceZero};
use crate::{Bifurcation, Branch, BranchKind, BranchPoint, QuantityLevel};
use jounce_orbits::{Condition, GrazingPoint, ParametricModel, ShootingEvaluation};

/// Largest slope of power of a seed, relative to the power, per fraction of a piece; the correction
/// removes it.
const MAX_SEED_SLOPE: f64 = 1e-7;

/// Point on a branch, on or near a curve.
#[derive(Debug, Clone)]
pub struct CurveSeed {
    /// Kind of the curve.
    pub kind: CurveKind,
    /// Level, for a level crossing.
    pub level: Option<QuantityLevel>,
    /// Drive cycles of the period.
    pub cycles: u32,
    /// State at the start of the period, energy coordinates.
    pub state: Vec<f64>,
    /// First key.
    pub parameter: f64,
    /// Mean power, W.
    pub mean_power_w: f64,
}

impl CurveSeed {
    /// Creates the seed of a bifurcation of a branch; a level crossing finds its level in `levels`.
    pub fn bifurcation(branch: &Branch, event: &Bifurcation, levels: &[QuantityLevel]) -> Self {
        Self {
            kind: CurveKind::Bifurcation(event.kind),
            level: levels
                .iter()
                .find(|level| event.level.as_ref() == Some(&level.text))
                .cloned(),
            cycles: branch.period_cycles,
            state: event.at.orbit.start().to_vec(),
            parameter: event.at.parameter,
            mean_power_w: event.at.orbit.mean_power_w,
        }
    }

    /// Returns the inner maxima of power of a branch, where power is stationary; `piece` gives the
    /// curve between two points.
    pub fn peaks<'h, H: ParametricModel + 'h>(
        branch: &Branch,
        piece: impl Fn([&BranchPoint; 2]) -> Option<CurvePiece<'h, H>>,
    ) -> Vec<Self> {
        let power_w = |k: usize| branch.points[k].orbit.mean_power_w;
        let inner = 1..branch.points.len().saturating_sub(1);
        let highest =
            inner.filter(|k| power_w(*k) >= power_w(k - 1) && power_w(*k) > power_w(k + 1));
        let zero_near = |k: usize| {
            [k - 1, k].into_iter().find_map(|k| {
                piece([&branch.points[k], &branch.points[k + 1]])?.maximum(
                    (0.0, 1.0),
                    MAX_SEED_SLOPE * branch.points[k].orbit.mean_power_w,
                )
            })
        };
        let seed = |zero: PieceZero| Self {
            kind: CurveKind::Peak,
            level: None,
            cycles: branch.period_cycles,
            state: zero.point.start().to_vec(),
            parameter: zero.point.parameter(),
            mean_power_w: zero.point.mean_power_w(),
        };
        highest.filter_map(zero_near).map(seed).collect()
    }

    /// Returns the curve from this seed, without points.
    pub fn curve(&self) -> BifurcationCurve {
        let level = self.level.as_ref().map(|level| level.text.clone());
        BifurcationCurve {
            kind: self.kind,
            level,
            period_cycles: self.cycles,
            points: Vec::new(),
            failures: Vec::new(),
        }
    }

    /// True when a curve has the kind and period of this seed.
    pub fn is_of(&self, curve: &BifurcationCurve) -> bool {
        self.curve().is_alike(curve)
    }

    /// Converts the seed into a point of a curve.
    pub fn point(&self, parameter_2: f64) -> BifurcationCurvePoint {
        BifurcationCurvePoint {
            parameter: self.parameter,
            parameter_2,
            mean_power_w: self.mean_power_w,
            stable: None,
        }
    }

    /// Returns the condition that is zero on the curve, given its first orbit; `None` for a kind
    /// that is not followed.
    pub fn condition(&self, evaluation: &ShootingEvaluation) -> Option<Condition> {
        Some(match self.kind {
            CurveKind::Peak => Condition::Peak,
            CurveKind::Bifurcation(BranchKind::Fold) => Condition::Multiplier(1.0),
            CurveKind::Bifurcation(BranchKind::PeriodDoubling) => Condition::Multiplier(-1.0),
            CurveKind::Bifurcation(BranchKind::NeimarkSacker) => Condition::Circle,
            CurveKind::Bifurcation(BranchKind::Grazing) => {
                Condition::Touching(GrazingPoint::of(evaluation)?)
            }
            CurveKind::Bifurcation(BranchKind::Level) => {
                let level = self.level.as_ref()?;
                Condition::Level(level.quantity, level.value)
            }
            CurveKind::Bifurcation(BranchKind::BranchPoint | BranchKind::Sticking) => return None,
        })
    }
}
