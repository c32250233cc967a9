//! Drawn parts of a harvester: bodies, contacts, drives, circuits, close-ups of gaps and plan views of
//! plates.

pub(super) mod bodies;
pub(super) mod circuit;
pub(super) mod close_up;
pub(super) mod contacts;
pub(super) mod drives;
pub(super) mod plan;
