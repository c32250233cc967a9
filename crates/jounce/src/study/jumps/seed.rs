//! Places on one line of the plane from which curves start.

use super::CurveKind;
use crate::orbit::Condition;
use crate::study::{Bifurcation, Branch, BranchKind};
use faer::ColRef;

/// A place on a branch, on or near a curve.
#[derive(Debug, Clone)]
pub struct Seed {
    /// What the curve is of.
    pub kind: CurveKind,
    /// Drive cycles of the period.
    pub cycles: u32,
    /// State at the start of the period, energy coordinates.
    pub state: Vec<f64>,
    /// First key.
    pub parameter: f64,
    /// Mean power, W.
    pub mean_power_w: f64,
}

impl Seed {
    /// A bifurcation of a branch.
    pub fn bifurcation(branch: &Branch, found: &Bifurcation) -> Self {
        Self {
            kind: CurveKind::Bifurcation(found.kind),
            cycles: branch.period_cycles,
            state: found.at.orbit.start().to_vec(),
            parameter: found.at.parameter,
            mean_power_w: found.at.orbit.mean_power_w,
        }
    }

    /// Maxima of power inside a branch: parabolas through three neighbouring points.
    pub fn peaks(branch: &Branch) -> Vec<Self> {
        let power_w = |k: usize| branch.points[k].orbit.mean_power_w;
        let inner = 1..branch.points.len().saturating_sub(1);
        let highest = inner.filter(|k| power_w(*k) >= power_w(k - 1) && power_w(*k) > power_w(k + 1));
        highest.map(|k| Self::vertex(branch, k)).collect()
    }

    fn vertex(branch: &Branch, k: usize) -> Self {
        let [a, b, c] = [k - 1, k, k + 1].map(|k| &branch.points[k]);
        let apart = |x: &[f64], y: &[f64]| (ColRef::from_slice(x) - ColRef::from_slice(y)).norm_l2();
        let [back, on] = [apart(a.orbit.start(), b.orbit.start()), apart(c.orbit.start(), b.orbit.start())];
        let [fall_back, fall_on] = [a, c].map(|other| b.orbit.mean_power_w - other.orbit.mean_power_w);
        // Vertex of the parabola through (-back, -fall_back), (0, 0), (on, -fall_on).
        let bend = 2.0 * (fall_on * back + fall_back * on);
        let way = if bend > 0.0 { (fall_back * on * on - fall_on * back * back) / bend } else { 0.0 };
        let (other, share) = if way < 0.0 { (a, -way / back) } else { (c, way / on) };
        let mix = |x: f64, y: f64| x + share * (y - x);
        Self {
            kind: CurveKind::Peak,
            cycles: branch.period_cycles,
            state: b.orbit.start().iter().zip(other.orbit.start()).map(|(x, y)| mix(*x, *y)).collect(),
            parameter: mix(b.parameter, other.parameter),
            mean_power_w: b.orbit.mean_power_w,
        }
    }

    /// What is zero on the curve; `None` for what is not followed.
    pub fn condition(&self) -> Option<Condition> {
        Some(match self.kind {
            CurveKind::Peak => Condition::Peak,
            CurveKind::Bifurcation(BranchKind::Fold) => Condition::Multiplier(1.0),
            CurveKind::Bifurcation(BranchKind::PeriodDoubling) => Condition::Multiplier(-1.0),
            CurveKind::Bifurcation(BranchKind::NeimarkSacker) => Condition::Circle,
            CurveKind::Bifurcation(BranchKind::Grazing) => Condition::Touching,
            CurveKind::Bifurcation(BranchKind::BranchPoint) => return None,
        })
    }
}
