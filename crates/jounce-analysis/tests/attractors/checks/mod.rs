//! Checks of the brute force: closed forms, steps of a tenth of the error, and a method without
//! events.

mod closed_forms;
pub mod published;
mod steps;
