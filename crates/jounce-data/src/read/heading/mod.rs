//! Headings of columns: name, unit, and whether the unit is of a level in decibels.

pub(super) mod decibels;
pub(super) mod name;
