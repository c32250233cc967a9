//! What a design problem of a harvester can have.

use crate::error::Error;
use crate::live::{Design, LiveAnalysis};
use jounce_control::Control;
use jounce_design::{AllowedLimit, Goal, allowed_limits};
use serde::Serialize;

/// Goals and limits among which a user chooses.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignOffer {
    /// Goals.
    pub goals: Vec<DesignGoal>,
    /// Limits.
    pub limits: Vec<AllowedLimit>,
}

/// A goal of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct DesignGoal {
    /// Name, as in the file.
    pub name: &'static str,
    /// Its SI unit.
    pub unit: &'static str,
    /// True where the goal depends on the number of starts.
    pub needs_starts: bool,
}

impl LiveAnalysis {
    /// Returns the goals and limits that a design can have.
    ///
    /// # Errors
    /// [`Error::Analysis`] for a design without a model.
    pub fn design_offer(&self, design: &Design, control: &Control) -> Result<DesignOffer, Error> {
        let model = self.model(design.spec(), control)?;
        let has_device = !design.spec().device.is_empty();
        let goals = Goal::ALL.into_iter();
        let goal = |goal: Goal| DesignGoal {
            name: goal.name(),
            unit: goal.unit(),
            needs_starts: goal.needs_starts(),
        };
        Ok(DesignOffer {
            goals: goals
                .filter(|goal| has_device || !goal.needs_device())
                .map(goal)
                .collect(),
            limits: allowed_limits(&model),
        })
    }
}
