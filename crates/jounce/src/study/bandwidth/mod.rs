//! How wide a branch is: its peak power, and where a stable orbit has at least half of it.
//!
//! Peaks and edges are places of the continued curve, each corrected by shooting, whichever method followed the branch.

mod answer;
mod measure;
mod merge;
mod piece;
mod segment;

pub use answer::{Bandwidth, Bandwidths, Edge, Interval, Limit, Peak};
pub use measure::BandwidthSearch;
pub(super) use piece::{Piece, Zero};
