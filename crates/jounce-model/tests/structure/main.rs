//! Modes of beams and masses against closed forms, published numbers, and a second method.
#![allow(clippy::unwrap_used, reason = "tests")]

mod composites;
mod exact;
mod exchange;
mod faults;
mod given_shapes;
mod laminates;
mod layers;
mod narrow_plates;
mod paper;
mod participation;
mod plates;
mod published;
mod several;
mod trees;
