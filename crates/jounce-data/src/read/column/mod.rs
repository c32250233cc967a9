//! Columns of a file: their numbers, where these are stored, and their names and units as written.

pub(super) mod numbers;
pub(super) mod raw;
pub(super) mod samples;
