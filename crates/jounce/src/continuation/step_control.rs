//! How long the next step may be.

/// Limits and the law of the step, lengths in the metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepControl {
    /// First step.
    pub first: f64,
    /// Longest step.
    pub longest: f64,
    /// Shortest step; below, the walk ends.
    pub shortest: f64,
    /// Wanted turn of the tangent per step, rad.
    pub turn: f64,
    /// Farthest that Newton may end from its guess, as a share of the step: farther away runs another curve.
    pub stray: f64,
    /// Most evaluations of Newton for a point that is to be trusted.
    pub most_evaluations: u32,
}

impl Default for StepControl {
    fn default() -> Self {
        Self {
            first: 0.02,
            longest: 0.4,
            shortest: 1e-9,
            turn: 0.25,
            stray: 0.1,
            most_evaluations: 5,
        }
    }
}

impl StepControl {
    /// True when the tangent turned so far that the curve may have been lost.
    pub fn refuses(&self, turn: f64) -> bool {
        turn > 3.0 * self.turn
    }

    /// True when Newton went so far, or took so long, on a step of a length that it may have found another curve.
    pub fn strayed(&self, way: f64, length: f64, evaluations: u32) -> bool {
        way > self.stray * length || evaluations > self.most_evaluations
    }

    /// Length of the step after one that took `evaluations` and turned the tangent by `turn`.
    pub fn after(&self, length: f64, evaluations: u32, turn: f64) -> f64 {
        let by_turn = (self.turn / turn.max(1e-12)).clamp(0.3, 2.0);
        let by_work = match evaluations {
            0..=2 => 2.0,
            3 => 1.5,
            4 => 1.0,
            _ => 0.5,
        };
        (length * f64::min(by_turn, by_work)).min(self.longest)
    }

    /// Length to try after a failure.
    pub fn shorter(&self, length: f64) -> f64 {
        0.35 * length
    }
}
