//! Commands that integrate in time.

pub mod design;
pub mod ensemble;
pub mod run;
mod run_lines;
pub mod study;
pub mod sweep;
