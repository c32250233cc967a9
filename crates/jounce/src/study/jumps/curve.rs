//! What a jump search answers.

use crate::study::BranchKind;
use serde::Serialize;

/// What is followed over two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CurveKind {
    /// The largest mean power along a branch over the first key.
    Peak,
    /// A bifurcation.
    #[serde(untagged)]
    Bifurcation(BranchKind),
}

impl CurveKind {
    /// Name in answers.
    pub fn name(self) -> &'static str {
        match self {
            CurveKind::Peak => "peak",
            CurveKind::Bifurcation(kind) => kind.name(),
        }
    }
}

/// A curve of one kind over two keys.
#[derive(Debug, Clone, PartialEq)]
pub struct JumpCurve {
    /// What happens on it.
    pub kind: CurveKind,
    /// Period of its orbits in drive cycles.
    pub period_cycles: u32,
    /// Points along it.
    pub points: Vec<JumpPoint>,
    /// Where it could not be followed, and why.
    pub failures: Vec<String>,
}

/// A point of it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct JumpPoint {
    /// First key, SI.
    pub parameter: f64,
    /// Second key, SI.
    pub parameter_2: f64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// On a curve of peaks, whether the orbit attracts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stable: Option<bool>,
}

impl JumpCurve {
    /// First key and power where the curve passes a value of the second, interpolated linearly.
    pub fn crossings(&self, parameter_2: f64) -> Vec<(f64, f64)> {
        let between = |pair: &[JumpPoint]| {
            let (a, b) = (&pair[0], &pair[1]);
            let t = (parameter_2 - a.parameter_2) / (b.parameter_2 - a.parameter_2);
            let at = |x: f64, y: f64| x + t * (y - x);
            (0.0..=1.0).contains(&t).then(|| (at(a.parameter, b.parameter), at(a.mean_power_w, b.mean_power_w)))
        };
        self.points.windows(2).filter_map(between).collect()
    }

    /// Joins a walk in the other direction from the same first point.
    pub fn joined(mut self, other: JumpCurve) -> JumpCurve {
        self.points.reverse();
        self.points.extend(other.points.into_iter().skip(1));
        self.failures.extend(other.failures);
        self
    }
}
