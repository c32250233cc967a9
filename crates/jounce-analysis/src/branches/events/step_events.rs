//! Events of a step of a branch.

use super::not_proved::NotProved;
use crate::branches::branch::Bifurcation;

/// Events of a step.
#[derive(Debug, Default)]
pub(in crate::branches) struct StepEvents {
    /// Located events, each with its distance along the step.
    located: Vec<(f64, Bifurcation)>,
    /// Events that were seen on the step and not located, or located with an error that exceeds the
    /// step.
    pub not_proved: Vec<NotProved>,
}

impl StepEvents {
    /// Adds a located event of a step between two values of the key.
    pub fn add(&mut self, along: f64, event: Bifurcation, ends: [f64; 2]) {
        self.not_proved.extend(NotProved::of_event(&event, ends));
        self.located.push((along, event));
    }

    /// Returns the events up to a distance along the step.
    pub fn until(mut self, end: f64) -> Self {
        self.located.retain(|(along, _)| *along <= end);
        self
    }

    /// Returns the located events in the order of the curve; near a fold the key alone gives none.
    pub fn bifurcations(mut self) -> impl Iterator<Item = Bifurcation> {
        self.located.sort_by(|x, y| x.0.total_cmp(&y.0));
        self.located.into_iter().map(|(_, event)| event)
    }
}
