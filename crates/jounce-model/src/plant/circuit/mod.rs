//! Electrical circuits: nodes, wiring, leakage, rectifiers and their events.

pub(super) mod bridge;
pub(super) mod electrical;
pub(super) mod event_function;
pub(super) mod leak;
pub(super) mod regulator;
mod wiring;
