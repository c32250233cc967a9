//! jounce simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
//!
//! A [`Harvester`] is read from a spec file. Each question is one method with its options and its
//! result:
//!
//! | question | method | options | result |
//! |---|---|---|---|
//! | natural frequencies, couplings and shapes | [`Harvester::modes`] | [`ModesOptions`] | [`ModesResult`] |
//! | frequency responses without contact | [`Harvester::frf`] | [`FrfOptions`] | [`FrfResult`] |
//! | response to noise without contact | [`Harvester::noise`] | [`NoiseOptions`] | [`NoiseResult`] |
//! | validity, with the issues of recordings | [`Harvester::check`] | | [`CheckResult`] |
//! | response from a start in time | [`Harvester::run`] | [`RunOptions`] | [`RunResult`] |
//! | attractors and how likely each is | [`Harvester::basins`] | [`BasinsOptions`] | [`BasinsResult`] |
//! | responses over values of a key | [`Harvester::sweep`] | [`SweepOptions`] | [`SweepResult`] |
//! | means over realisations of noise | [`Harvester::ensemble`] | [`EnsembleOptions`] | [`EnsembleResult`] |
//! | one quantity over several keys | [`Study::run`] | [`StudyOptions`] | [`StudyStatus`] |
//! | keys that fit measurements | [`Harvester::fit`] | [`Features`] | [`FitResult`] |
//! | simulated recordings of sensors | [`Harvester::rig`] | [`RigOptions`] | [`RigResult`] |
//! | branches of periodic orbits over a key | [`Harvester::branch`] | [`BranchOptions`] | [`BranchResult`] |
//! | bifurcation curves in two keys | [`Harvester::bifurcations`] | [`BifurcationsOptions`] | [`BifurcationsResult`] |
//! | bifurcation diagram over a key | [`Harvester::diagram`] | [`DiagramOptions`] | [`DiagramResult`] |
//!
//! [`materials`], [`starters`], [`schema`] and [`key_reference`] help to write a spec;
//! [`Harvester::drawing`] draws it; [`reproduce`] recomputes a published paper.
//!
//! A [`Recording`] is read from a file of an instrument, with its data-quality issues:
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
mod bifurcations;
mod branch;
mod check;
mod contact;
mod continuation;
mod diagram;
mod ensemble;
mod error;
mod fit;
mod frf;
mod harvester;
mod journal;
pub mod live;
mod measured_frf;
mod measured_modes;
mod modes;
mod noise;
mod options;
mod periodic;
mod power;
mod questions;
mod read;
mod recording;
mod reference;
mod reproduce;
mod rig;
mod run;
mod study;
mod sweep;

pub use bifurcations::{BifurcationCurve, BifurcationsOptions, BifurcationsResult};
pub use branch::{
    Bifurcation, Branch, BranchOptions, BranchPoint, BranchResult, HalfPowerBandwidth, NotProved,
    OrbitMethod, OrbitQuantity, Termination, TerminationReason, band_limit_text,
};
pub use diagram::{
    DiagramDirection, DiagramJournal, DiagramOptions, DiagramPoint, DiagramResult, SectionPoint,
};
pub use ensemble::{EnsembleOptions, EnsemblePatch, EnsembleResult, EnsembleStop, VoltageSpectrum};
mod segments;
mod spectra;

pub use basins::{AttractorResult, BasinsOptions, BasinsResult, FailedStart, StartPoint};
pub use check::{CheckResult, DriveIssue};
pub use contact::{ContactOptions, ContactResult, FixedLawResult, HitResult};
pub use error::{Error, ErrorDetails, ErrorKind};
pub use fit::FitResult;
pub use frf::{FrfOptions, FrfResponse, FrfResult};
pub use harvester::{Harvester, KeyValue};
pub use jounce_core::analysis::Model;
pub use jounce_core::analysis::{
    AttractorKind, AttractorTrack, BandInterval, BandLimit, BifurcationCurvePoint, BranchKind,
    CurveKind, GridError, IntervalEdge, PowerPeak, TrackPoint, Transition,
};
pub use jounce_core::analysis::{IntervalOver, Journal, Member, SweepDirection};
pub use jounce_core::integrate::Control;
pub use jounce_core::linear::{
    Coupling, Density, RandomLoad, RandomPatch, RandomPoint, RandomStop,
};
pub use jounce_core::material::{Active, Material};
pub use jounce_core::picture::{Drawing, Figure};
pub use jounce_core::reproduce::Claim;
pub use jounce_core::run::{ChargeResult, StartState, StopResult, Warning};
pub use jounce_core::signal::{Samples, SignalError, Spectrum, Window};
pub use jounce_core::spec::{Fault, Faults, KeyRange, NumericKey, Quantity, Spec, SpecFile};
pub use jounce_core::starter::Starter;
pub use jounce_core::table::{Manifest, Table, Values};
pub use jounce_data::read::RawChannel;
pub use jounce_data::recording::{
    Channel, ChannelError, Grid, Issue, Over, Quantity as MeasuredQuantity,
};
pub use jounce_measure::contact::AllowedLaws;
pub use jounce_measure::draw::PulseFigure;
pub use jounce_measure::fit::{
    Features, FitError, FitResult as FitEstimate, FittedCurve, FittedDeviation, FittedFeature,
    FittedKey,
};
pub use jounce_measure::segmentation::{Candidate, MAX_PERIOD_CYCLES, MergeReason, MergedChange};
pub use jounce_measure::spectral::HitWarning;
pub use measured_frf::{
    FrfEstimator, FunctionParts, MeasuredFrfOptions, MeasuredFrfResult, MeasuredResponse, PerG,
};
pub use measured_modes::{ComplexValues, MeasuredMode, MeasuredModesOptions, MeasuredModesResult};
pub use modes::{BeamShapes, ModeResult, ModesOptions, ModesResult, PatchCoupling, PointShape};
pub use noise::{NoiseOptions, NoiseResult};
pub use options::{OptionDefinition, check_tolerance, definitions};
pub use periodic::check_drives;
pub use power::{OrderAmplitude, PowerOptions, PowerRecord, PowerResult};
pub use questions::{Question, questions};
pub use read::{
    ChannelResult, Conversion, ConvertOptions, ReadResult, RecordedFile, RecordingResult,
    ShapeResult,
};
pub use recording::{ChannelList, ChosenChannel, ReadOptions, Recording, UsesChannels};
pub use reference::{key_reference, materials, schema, starter, starters};
pub use reproduce::{ReproduceOptions, ReproduceResult, reproduce};
pub use rig::{BaseMotion, RigOptions, RigResult};
pub use run::{History, HistorySamples, LoadResult, PatchResult, RunOptions, RunResult};
pub use segments::{SegmentResult, SegmentsOptions, SegmentsResult};
pub use spectra::{OrderPeak, SegmentWindow, SpectraOptions, SpectraResult};
pub use study::{Shard, Study, StudyFolder, StudyOptions, StudyStatus};
pub use sweep::{SweepOptions, SweepOrder, SweepPoint, SweepResult};

/// Rust code of the README, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}

/// Rust code of the book, compiled with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../../../book/src/introduction.md")]
mod introduction {}
