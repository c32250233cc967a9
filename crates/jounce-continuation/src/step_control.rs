//! Control of the step length.

/// Limits and targets of the step length; lengths are in the metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepControl {
    /// First step.
    pub first: f64,
    /// Longest step.
    pub longest: f64,
    /// Shortest step; continuation ends below it.
    pub shortest: f64,
    /// Target turn of the tangent per step, rad.
    pub turn: f64,
    /// Largest distance from predictor to solution, as a fraction of the step: a larger one
    /// suggests another curve.
    pub stray: f64,
    /// Largest number of evaluations for a point to be accepted.
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
    /// True when the tangent turned so far that the point may be on another curve.
    pub fn refuses(&self, turn: f64) -> bool {
        turn > 3.0 * self.turn
    }

    /// True when Newton moved so far, or took so many evaluations, that it may have found another
    /// curve.
    pub fn strayed(&self, distance: f64, length: f64, evaluations: u32) -> bool {
        distance > self.stray * length || evaluations > self.most_evaluations
    }

    /// Returns the next length, after a step that took `evaluations` and turned the tangent by
    /// `turn`.
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

    /// Returns the length to try after a failure.
    pub fn shorter(&self, length: f64) -> f64 {
        0.35 * length
    }
}
