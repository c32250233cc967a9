//! A beam: cross-sections, segments and elements.

mod coverage;
pub(super) mod element;
pub(super) mod layout;
pub(super) mod mesh;
mod ply;
pub mod section;
