//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! A [`Harvester`] is read from a spec file. Each question is one method with its options and its
//! result:
//!
//! | question | method | options | result |
//! |---|---|---|---|
//! | response from a start in time | [`Harvester::run`] | [`RunOptions`] | [`RunResult`] |
//! | attractors and how likely each is | [`Harvester::basins`] | [`BasinsOptions`] | [`BasinsResult`] |
//! | simulated recordings of sensors | [`Harvester::rig`] | [`RigOptions`] | [`RigResult`] |
//! | contact laws of force pulses | [`Recording::contact`] | [`ContactOptions`] | [`ContactResult`] |
//! | attractors that a recording shows | [`Recording::segments`] | [`SegmentsOptions`] | [`SegmentsResult`] |
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
mod contact;
mod error;
mod harvester;
mod options;
mod periodic;
mod recording;
mod rig;
mod run;
mod segments;

pub use basins::{AttractorResult, BasinsOptions, BasinsResult, FailedStart, StartPoint};
pub use contact::{ContactOptions, ContactResult, FixedLawResult, HitResult};
pub use error::{Error, ErrorKind};
pub use harvester::{Harvester, KeyValue};
pub use jounce_core::integrate::Control;
pub use jounce_core::run::StartState;
pub use jounce_data::read::RawChannel;
pub use jounce_data::recording::{Channel, Grid, Issue, Over, Quantity};
pub use jounce_measure::contact::AllowedLaws;
pub use jounce_measure::draw::PulseFigure;
pub use jounce_measure::segmentation::{Candidate, MAX_PERIOD_CYCLES, MergeReason, MergedChange};
pub use jounce_measure::spectral::HitWarning;
pub use options::{OptionDefinition, check_tolerance, definitions};
pub use periodic::check_drives;
pub use recording::{ChannelList, ChosenChannel, ReadOptions, Recording, UsesChannels};
pub use rig::{BaseMotion, RigOptions, RigResult};
pub use run::{History, HistorySamples, LoadResult, PatchResult, RunOptions, RunResult};
pub use segments::{SegmentResult, SegmentsOptions, SegmentsResult};

/// Rust code of the README, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}

/// Rust code of the book, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../book/src/introduction.md")]
mod introduction {}
