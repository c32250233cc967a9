//! Drawn parts of a harvester: bodies, contacts, drives, circuits and close-ups of gaps.

pub(super) mod bodies;
pub(super) mod circuit;
pub(super) mod close_up;
pub(super) mod contacts;
pub(super) mod drives;
