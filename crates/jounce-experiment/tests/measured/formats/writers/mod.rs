//! Minimal writers of binary formats, from their specifications.
pub mod mat;
pub mod tdms;
pub mod wav;
pub mod zip;
