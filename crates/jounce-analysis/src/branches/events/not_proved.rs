//! Intervals of a branch where the events are not proved.

use crate::branches::branch::{Bifurcation, BranchKind};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// Interval of a branch on which the listed events of a kind are not proved: there may be more, or
/// fewer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotProved {
    /// Kind of the event.
    pub event: BranchKind,
    /// Value of the key at the begin of the interval, SI.
    pub from: f64,
    /// Value of the key at the end of the interval, SI.
    pub to: f64,
    /// Reason why the proof failed.
    pub why: ProofGap,
}

/// Reason why the events of an interval are not proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum ProofGap {
    /// No orbit half-way between two orbits was found: they may lie on different parts of the
    /// curve.
    NoMidpoint,
    /// The proof fails on the smallest steps too.
    SmallestSteps,
    /// An event was seen on a step, and its point was not found.
    NotLocated,
    /// The error of a located event exceeds the step on which it was seen.
    LargeError,
}

impl Display for ProofGap {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            ProofGap::NoMidpoint => "no orbit was found at the midpoint of a step",
            ProofGap::SmallestSteps => "not proved on the smallest steps",
            ProofGap::NotLocated => "the point of an event was not found on its step",
            ProofGap::LargeError => {
                "the error of a located event exceeds the step on which it was seen"
            }
        })
    }
}

impl NotProved {
    /// Returns the interval of the error of an event that was seen on a step between two values of
    /// the key, where it exceeds this step.
    pub fn of_event(event: &Bifurcation, ends: [f64; 2]) -> Option<Self> {
        let at = event.at.parameter;
        let error = event.parameter_error?;
        ends.iter()
            .all(|end| error > (at - end).abs())
            .then_some(Self {
                event: event.kind,
                from: at - error,
                to: at + error,
                why: ProofGap::LargeError,
            })
    }

    /// Adds an interval to a list, or extends the previous one of the same kind.
    pub fn add(list: &mut Vec<Self>, event: BranchKind, [from, to]: [f64; 2], why: ProofGap) {
        match list
            .iter_mut()
            .rev()
            .find(|known| known.event == event)
            .filter(|known| known.to == from && known.why == why)
        {
            Some(known) => known.to = to,
            None => list.push(Self {
                event,
                from,
                to,
                why,
            }),
        }
    }
}
