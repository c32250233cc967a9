//! Bifurcation diagrams by integration: Poincare section at the start of each drive cycle, over one
//! key of a spec.

mod attractor_matching;
mod attractor_track;
mod diagram_point;
mod diagram_search;
mod section;

pub use attractor_matching::AttractorTracks;
pub use attractor_track::{AttractorTrack, TrackPoint, Transition};
pub use diagram_point::DiagramPoint;
pub use diagram_search::{Diagram, DiagramOrder};
pub use section::SectionPoint;
