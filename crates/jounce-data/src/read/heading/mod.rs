//! Headings of columns: name, unit, and whether the unit is of a level in decibels.

pub(super) mod axis;
pub(super) mod decibels;
pub(super) mod name;
mod round_brackets;
