//! Commands on the text of a spec.

pub mod check;
pub mod cite;
pub mod export;
pub mod import;
pub mod materials;
pub mod new;
pub mod restitution;
pub mod show;
