//! Computations of a live page: the design changes in small steps, and every curve follows it.
//!
//! A [`Design`] is a harvester with the numbers that the page has set. A [`LiveAnalysis`] reuses
//! what it has computed for the previous designs. Each computation is one method with its options
//! and its result. It ends within the integration of one period after its control is stopped.
//!
//! | computation | method |
//! |---|---|
//! | every number with its unit and the range of its slider | [`Design::controls`] |
//! | numbers that the spec lacks and may have | [`Design::optional_keys`] |
//! | scale drawing with the keys that move its parts | [`Design::drawing`] |
//! | mode shapes along its beams and over its plates | [`Design::mode_figures`] |
//! | the harvester without contact over a key | [`LiveAnalysis::first_response`] |
//! | branches over a key, carried over from the previous design | [`LiveAnalysis::coarse_response`] |
//! | all branches over a key; their peak and bandwidth | [`LiveAnalysis::fine_response`], [`LiveAnalysis::bandwidth`] |
//! | orbit of one point or attractor with the motion of its beams and plates | [`LiveAnalysis::orbit`] |
//! | point of a branch that has the orbit of an attractor, or of a link | [`LiveAnalysis::branch_point`] |
//! | stretch of the motion of an attractor without a period | [`LiveAnalysis::aperiodic_motion`] |
//! | attractors of a design with the peaks and warnings of their orbits | [`LiveAnalysis::operating_point`] |
//! | points up and down over a key, one by one | [`Design::sweep`] |
//! | power over the load, without and with contact | [`LiveAnalysis::linear_load`], [`Design::load_sweep`] |
//! | options of [`crate::Harvester::basins`] for a plane of starts | [`Design::in_plane`] |
//! | the best design, with each better one as soon as it is found | [`Design::search`] |
//! | band of the power over a key, under tolerances | [`LiveAnalysis::band`] |
//! | response to noise or to a recording | [`LiveAnalysis::excite`] |
//! | a computation for several pages | [`LiveAnalysis::fork`], [`LiveAnalysis::adopt`] |

mod analysis;
mod channel_file;
mod controls;
mod design;
mod drawing;
mod excitation;
mod key_span;
mod load;
mod mode_figures;
mod orbits;
mod plane;
mod recent;
mod responses;
mod search;
mod sweep;
mod time_history;

pub use analysis::{LiveAnalysis, ResponseHistory};
pub use channel_file::ChannelFile;
pub use controls::{DesignControl, OptionalKey, SliderScale};
pub use design::Design;
pub use drawing::{DesignDrawing, Grip, GripKind};
pub use excitation::{Excitation, ExcitationResult};
pub use jounce_analysis::Bandwidth;
pub use jounce_plot::ViewRoom;
pub use key_span::KeySpan;
pub use load::{LinearLoad, LoadOptions};
pub use mode_figures::ModeFigure;
pub use orbits::{
    AperiodicMotion, AttractorPeaks, AttractorPlace, BeamMotion, BranchPlace, ForceCurves,
    LimitShares, OperatingPoint, OrbitIdentity, OrbitPlace, OrbitResult, OrbitStop, PlateMotion,
    ReachedLimit, SoughtOrbit,
};
pub use responses::{
    Draft, DraftOrigin, LinearCurve, ResponseBifurcation, ResponseBranch, ResponseOptions,
    ResponseResult,
};
pub use search::{
    BandOptions, BandResult, BetterDesign, DesignFields, DesignGoal, DesignOffer, FieldFault,
    FoundDesign,
};
pub use sweep::LivePoint;
pub use time_history::{Extremes, SpectralDensity};
