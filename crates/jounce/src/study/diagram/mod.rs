//! Bifurcation diagrams by marching: where the motion is at the start of each drive cycle, over one key of a spec.

mod history;
mod lineage;
mod march;
mod section;
mod visit;

pub use history::History;
pub use lineage::{Lineage, Seen, Turn};
pub use march::{Diagram, Order};
pub use section::SectionPoint;
pub use visit::Visit;
