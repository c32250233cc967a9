//! Result of a continuation of bifurcation curves.

use super::BifurcationsOptions;
use jounce_analysis as analysis;
use jounce_analysis::{BifurcationCurvePoint, CurveKind};
use serde::Serialize;

/// Bifurcation curves in the plane of two keys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BifurcationsResult {
    /// Path of the first key.
    pub key: String,
    /// SI unit of the first key.
    pub unit: String,
    /// Path of the second key.
    pub key_2: String,
    /// SI unit of the second key.
    pub unit_2: String,
    /// Curves in the order of their computation.
    pub curves: Vec<BifurcationCurve>,
    /// Note on the curves that the search may miss, and on the options that find more.
    pub note: String,
    /// Options of the search.
    #[serde(skip)]
    pub options: BifurcationsOptions,
}

/// Curve of one kind of bifurcation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BifurcationCurve {
    /// Kind of the bifurcation, or `peak`: the largest mean power along a branch.
    pub kind: CurveKind,
    /// Level of the curve, as given; `None` for other kinds.
    pub level: Option<String>,
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// Points along the curve: values of both keys, SI, and mean power, W.
    pub points: Vec<BifurcationCurvePoint>,
    /// Places where continuation stopped early, with the reason.
    pub failures: Vec<String>,
}

impl BifurcationCurve {
    pub(super) fn new(curve: analysis::BifurcationCurve) -> Self {
        Self {
            kind: curve.kind,
            level: curve.level,
            period_cycles: curve.period_cycles,
            points: curve.points,
            failures: curve.failures,
        }
    }

    /// Returns the name: the level as given, else the kind.
    pub fn name(&self) -> &str {
        self.level.as_deref().unwrap_or(self.kind.name())
    }

    /// True where continuation stopped early at no end.
    pub fn is_complete(&self) -> bool {
        self.failures.is_empty()
    }
}
