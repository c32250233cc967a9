//! Commands that integrate in time.

pub mod design;
pub mod ensemble;
pub mod run;
pub mod study;
pub mod sweep;
