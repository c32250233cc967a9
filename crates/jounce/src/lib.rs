//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! A [`Harvester`] is read from a spec file. Each question is one method with its options and its
//! result:
//!
//! | question | method | options | result |
//! |---|---|---|---|
//! | response from a start in time | [`Harvester::run`] | [`RunOptions`] | [`RunResult`] |
//! | attractors and how likely each is | [`Harvester::basins`] | [`BasinsOptions`] | [`BasinsResult`] |
//!
//! [`live`] has the computations of the live page, which follow a design through small steps.
//!
//! Options have defaults: write the fields that differ, then `..Default::default()`. Results are
//! plain data; serialised, they are the JSON of the command line. Every name ends in its unit.
//!
//! All errors are one type, [`Error`]; [`Error::kind`] separates invalid input, missing convergence
//! and a stop by the user. A [`Control`] reports the progress of a long computation and stops it.
//!
//! The computations are in `jounce_core`, recordings in `jounce_data` and `jounce_measure`; their
//! interfaces may change.

mod basins;
mod error;
mod harvester;
pub mod live;
mod options;
mod periodic;
mod run;

pub use basins::{AttractorResult, BasinsOptions, BasinsResult, FailedStart, StartPoint};
pub use error::{Error, ErrorKind};
pub use harvester::{Harvester, KeyValue};
pub use jounce_core::integrate::Control;
pub use jounce_core::run::StartState;
pub use options::{OptionDefinition, check_tolerance, definitions};
pub use periodic::check_drives;
pub use run::{History, HistorySamples, LoadResult, PatchResult, RunOptions, RunResult};

/// Rust code of the README, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}

/// Rust code of the book, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../book/src/introduction.md")]
mod introduction {}
