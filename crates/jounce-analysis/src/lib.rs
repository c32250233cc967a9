//! Analyses: many runs of one spec.

mod bandwidth;
mod basins;
mod bifurcations;
mod branches;
mod diagram;
mod ensemble;
mod frequency_branch;
mod journal;
mod key_line;
mod model;
mod model_at_start;
mod nearest_fold;
mod nearest_peak;
mod orbit_derivatives;
mod orbit_limits;
mod parameter;
mod recognition;
pub mod run;
pub mod study;
mod sweep;
mod sweep_point;

pub use bandwidth::{
    BandInterval, BandLimit, Bandwidth, BandwidthSearch, Bandwidths, IntervalEdge, PowerPeak,
};
pub use basins::{
    Attractor, BasinFraction, Basins, BasinsResult, Cloud, Grid, GridAxis, GridError, GridSide,
    InitialStates, wilson,
};
pub use bifurcations::{
    BifurcationCurve, BifurcationCurvePoint, BifurcationSearch, CurveKind, KeyPlane,
};
pub use branches::{
    Bifurcation, Branch, BranchKind, BranchOptions, BranchPoint, BranchSearch, BranchUpdate,
    LineErrors, Termination, UpdatedBranches, WarmStart,
};
pub use branches::{
    Extrapolation, KnownOrbit, NotProved, OrbitMethodKind, ProofGap, QuantityLevel,
};
pub use diagram::{
    AttractorTrack, AttractorTracks, Diagram, DiagramOrder, DiagramPoint, SectionPoint, TrackPoint,
    Transition,
};
pub use ensemble::{
    ContactCount, DeviceCount, DeviceEstimates, Ensemble, EnsembleResult, Estimate, IntervalOver,
    Member, MemberDevice, MemberStop, StopEstimates, VoltageSpectrum,
};
pub use frequency_branch::{NotFollowed, drive_frequency, farthest_hz};
pub use journal::{Journal, JournalError};
pub use key_line::KeyLine;
pub use model::{AnalysisError, Model, has_same_modes};
pub use model_at_start::ModelAtStart;
pub use nearest_fold::{
    BifurcationPlace, FoldPlace, NearestBifurcations, nearest_bifurcations, nearest_fold,
};
pub use nearest_peak::{PeakDerivative, PeakPlace, nearest_peak};
pub use orbit_derivatives::{
    AcrossGrazing, Derivative, DerivativeAccuracy, DerivativeKey, NearestGrazing, OrbitDerivatives,
    fold_derivatives, nearest_grazing, orbit_derivatives,
};
pub use parameter::Parameter;
pub(crate) use recognition::settled_orbits;
pub use recognition::{
    Aperiodic, AttractingOrbit, AttractorKind, Lyapunov, MIN_TRANSIENT_CYCLES, ReachedOrbit,
    Recognition, Recognizer, SteadyState,
};
pub use recognition::{largest_exponent, settled_orbit};
pub use sweep::{Sweep, SweepOrder};
pub use sweep_point::{SweepDirection, SweepPoint};
