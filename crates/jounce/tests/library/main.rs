//! The library as its users call it; one program, because each links everything.
#![allow(clippy::unwrap_used, reason = "tests")]

mod cite;
mod exchange;
mod grazing;
mod live;
mod live_recognition;
mod options;
mod power;
mod restitution;
mod study_options;
mod sweep_journal;
mod universal;
