//! Commands on the text of a spec.

pub mod check;
pub mod materials;
pub mod new;
pub mod show;
