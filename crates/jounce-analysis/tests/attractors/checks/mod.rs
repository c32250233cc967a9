//! Checks of the brute force: closed forms, steps of a tenth of the error, and a method without
//! events.

mod closed_forms;
mod published;
mod steps;
