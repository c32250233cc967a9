//! Continuation of one branch from one of its orbits, with its events and its end.

mod adapt_order;
mod detection;
mod ending;
pub(super) mod halves;
mod noncontact;
pub(super) mod orbit_point;
mod parameter_error;
mod range_end;
mod sheet_guard;
pub(super) mod tracer;
mod tracer_start;
