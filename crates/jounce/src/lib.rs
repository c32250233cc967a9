//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! ```
//! use jounce::{Harvester, RunOptions};
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
//! let mut harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
//! harvester.set("stop.tip.gap", "0.5 mm")?;
//! let result = harvester.run(&RunOptions { tolerance: Some(1e-8), ..Default::default() })?;
//! println!("{} W, settled: {:?}", result.mean_power_w, result.settled);
//! # Ok::<(), jounce::Error>(())
//! ```
//!
//! A [`Harvester`] is read from a spec file. Each question is one method with its options and its
//! result. The exceptions are [`Harvester::check`] and [`Harvester::cite`] without options, [`Harvester::fit`] with
//! [`Features`], [`Study::run`], a method of a [`Study`], and [`Design::run`], one of a [`Design`]:
//!
//! | question | method | options | result |
//! |---|---|---|---|
//! | validity, with the issues of recordings | [`Harvester::check`] | | [`CheckResult`] |
//! | publications that its results rest on | [`Harvester::cite`] | | [`CiteResult`] |
//! | natural frequencies, couplings and shapes | [`Harvester::modes`] | [`ModesOptions`] | [`ModesResult`] |
//! | frequency responses without contact | [`Harvester::frf`] | [`FrfOptions`] | [`FrfResult`] |
//! | response to noise without contact | [`Harvester::noise`] | [`NoiseOptions`] | [`NoiseResult`] |
//! | response from a start in time | [`Harvester::run`] | [`RunOptions`] | [`RunResult`] |
//! | responses over values of a key | [`Harvester::sweep`] | [`SweepOptions`] | [`SweepResult`] |
//! | branches of periodic orbits over a key | [`Harvester::branch`] | [`BranchOptions`] | [`BranchResult`] |
//! | bifurcation curves in two keys | [`Harvester::bifurcations`] | [`BifurcationsOptions`] | [`BifurcationsResult`] |
//! | bifurcation diagram over a key | [`Harvester::diagram`] | [`DiagramOptions`] | [`DiagramResult`] |
//! | attractors and how likely each is | [`Harvester::basins`] | [`BasinsOptions`] | [`BasinsResult`] |
//! | derivatives of results of an orbit | [`Harvester::sensitivity`] | [`SensitivityOptions`] | [`SensitivityResult`] |
//! | means over realisations of noise | [`Harvester::ensemble`] | [`EnsembleOptions`] | [`EnsembleResult`] |
//! | one quantity over several keys | [`Study::run`] | [`StudyOptions`] | [`parts::StudyStatus`] |
//! | keys with the largest power within limits | [`Design::run`] | [`DesignOptions`] | [`DesignResult`] |
//! | keys that fit measurements | [`Harvester::fit`] | [`Features`] | [`FitResult`] |
//! | the model for other programs | [`Harvester::export`] | [`ExportOptions`] | [`ExportResult`] |
//! | structures of other programs | [`import_matrices`], [`reduce_matrices`] | [`ImportOptions`] | [`ImportResult`] |
//! | restitution from materials | [`restitution()`] | [`RestitutionOptions`] | [`RestitutionResult`] |
//! | simulated recordings of sensors | [`Harvester::rig`] | [`RigOptions`] | [`RigResult`] |
//!
//! A [`RecordedFile`] lists the recordings in a file of an instrument and converts them; it need
//! not hold their samples in memory. A [`Recording`] is one of them, with its samples and its
//! data-quality issues:
//!
//! | question | method | options | result |
//! |---|---|---|---|
//! | contents of a file, and its conversion | [`RecordedFile::result`], [`RecordedFile::convert`] | [`ReadOptions`], [`ConvertOptions`] | [`ReadResult`] |
//! | mean power of voltages over their loads | [`Recording::power`] | [`PowerOptions`] | [`PowerResult`] |
//! | spectra of a channel | [`Recording::spectra`] | [`SpectraOptions`] | [`SpectraResult`] |
//! | frequency responses of a hammer or shaker test | [`Recording::measured_frf`] | [`MeasuredFrfOptions`] | [`MeasuredFrfResult`] |
//! | modes of a test | [`Recording::measured_modes`] | [`MeasuredModesOptions`] | [`MeasuredModesResult`] |
//! | contact laws of force pulses | [`Recording::contact`] | [`ContactOptions`] | [`ContactResult`] |
//! | attractors that a recording shows | [`Recording::segments`] | [`SegmentsOptions`] | [`SegmentsResult`] |
//!
//! [`materials`], [`chips`], [`starters`], [`schema`] and [`key_reference`] help to write a spec;
//! [`Harvester::drawing`] draws it; [`reproduce`] recomputes a published paper. [`questions`] lists
//! all questions with their names on the command line and in Python.
//!
//! Options have defaults: write the fields that differ, then `..Default::default()`. Results are
//! plain data; serialised, they are the JSON of the command line. Names of quantities end in their
//! unit. The types of their fields are in [`parts`]. Tables and figures are methods of the results.
//!
//! All errors are one type, [`Error`]. Its message names the value, what is allowed and what to
//! try; [`Error::kind`] separates invalid input, missing convergence and a stop by the user. A
//! [`Control`] reports the progress of a long computation and stops it.
//!
//! The computations are in the crates below this one (`jounce_model`, `jounce_dynamics`,
//! `jounce_orbits`, `jounce_analysis` and others); their interfaces may change.

mod basins;
mod bifurcations;
mod branch;
mod check;
mod cite;
mod contact;
mod continuation_options;
mod design;
mod diagram;
mod ensemble;
mod error;
mod export;
mod fit;
mod frf;
mod harvester;
mod import;
mod journal;
mod leaves;
pub mod live;
mod measured_frf;
mod measured_modes;
mod modes;
mod noise;
mod options;
pub mod parts;
mod periodic;
mod power;
mod questions;
mod read;
mod record;
mod recording;
mod reference;
mod reproduce;
mod restitution;
mod rig;
mod run;
mod segments;
mod sensitivity;
mod spectra;
mod study;
mod sweep;

pub use basins::{BasinsOptions, BasinsResult};
pub use bifurcations::{BifurcationsOptions, BifurcationsResult};
pub use branch::{BranchOptions, BranchResult};
pub use check::CheckResult;
pub use cite::{Citation, CiteResult};
pub use contact::{ContactOptions, ContactResult};
pub use design::{Design, DesignOptions, DesignResult};
pub use diagram::{DiagramOptions, DiagramResult};
pub use ensemble::{EnsembleOptions, EnsembleResult};
pub use error::{Error, ErrorDetails, ErrorKind};
pub use export::{ExportOptions, ExportResult};
pub use fit::FitResult;
pub use frf::{FrfOptions, FrfResult};
pub use harvester::{Harvester, KeyValue};
pub use import::{ImportOptions, ImportResult, ImportedMode, import_matrices, reduce_matrices};
pub use jounce_analysis::Model;
pub use jounce_analysis::run::StartState;
pub use jounce_control::Control;
pub use jounce_experiment::fit::Features;
pub use jounce_io::table::Table;
pub use jounce_plot::Figure;
pub use jounce_spec::{Spec, SpecFile};
pub use measured_frf::{MeasuredFrfOptions, MeasuredFrfResult};
pub use measured_modes::{MeasuredModesOptions, MeasuredModesResult};
pub use modes::{ModesOptions, ModesResult, PlateShapes};
pub use noise::{NoiseOptions, NoiseResult};
pub use options::{OptionDefinition, check_tolerance, definitions};
pub use periodic::check_drives;
pub use power::{PowerOptions, PowerResult};
pub use questions::{Question, questions};
pub use read::{ConvertOptions, ReadResult, RecordedFile};
pub use recording::{ReadOptions, Recording};
pub use reference::{chips, key_reference, materials, schema, starter, starters};
pub use reproduce::{ReproduceOptions, ReproduceResult, reproduce};
pub use restitution::{RestitutionOptions, RestitutionResult, restitution};
pub use rig::{RigOptions, RigResult};
pub use run::{RunOptions, RunResult};
pub use segments::{SegmentsOptions, SegmentsResult};
pub use sensitivity::{SensitivityOptions, SensitivityResult};
pub use spectra::{SpectraOptions, SpectraResult};
pub use study::{Study, StudyFolder, StudyOptions};
pub use sweep::{SweepOptions, SweepResult};

/// Rust code of the README, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}

/// Rust code of the book, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../book/src/introduction.md")]
mod introduction {}
