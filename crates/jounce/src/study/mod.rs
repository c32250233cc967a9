//! Studies: many runs of one spec.

mod bandwidth;
mod basins;
mod branches;
mod diagram;
mod ensemble;
mod journal;
mod jumps;
mod orbit_limits;
mod parameter;
mod prepared;
mod recognition;
mod started;
mod sweep;
mod sweep_point;

pub use bandwidth::{Bandwidth, BandwidthSearch, Bandwidths, Edge, Interval, Limit, Peak};
pub use basins::{Attractor, Basins, BasinsAnswer, Cloud, Grid, GridAxis, GridError, GridSide, Share, Starts, wilson};
pub use branches::{Bifurcation, Branch, BranchCarry, BranchChase, BranchKind, BranchOptions, BranchPoint, BranchSearch, Carried, Ending};
pub use branches::{KnownOrbit, Level, Method, NotProved, Trend};
pub use diagram::{Diagram, History, Lineage, Order, SectionPoint, Seen, Turn, Visit};
pub use ensemble::{ContactCount, Ensemble, EnsembleAnswer, Estimate, IntervalOver, Member, MemberStop, StopEstimates, VoltageSpectrum};
pub use journal::{Journal, JournalError};
pub use jumps::{CurveKind, JumpCurve, JumpPoint, JumpSearch, KeyPlane};
pub use parameter::Parameter;
pub use prepared::{Prepared, StudyError};
pub(crate) use recognition::settled_orbits;
pub use recognition::{Aperiodic, AttractingOrbit, AttractorKind, Lyapunov, Recognition, Recognizer, SteadyState};
pub use recognition::{largest_exponent, settled_orbit};
pub use started::Started;
pub use sweep::{Direction, Sweep};
pub use sweep_point::{SweepPoint, Way};
