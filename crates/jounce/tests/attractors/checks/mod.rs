//! The brute force itself: against closed forms, against steps of a tenth of the error, against a plain method without events.

mod closed_forms;
mod published;
mod steps;
