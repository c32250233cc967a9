//! Bandwidth of a branch: peak power, and where a stable orbit has at least half of it.
//!
//! Peaks and edges are points of the continued curve, each corrected by shooting, whichever method
//! traced the branch.

mod curve_piece;
mod measure;
mod merge;
mod result;
mod stability_edge;
mod stable_segment;

pub(super) use curve_piece::{CurvePiece, PieceZero};
pub use measure::BandwidthSearch;
pub use result::{BandInterval, BandLimit, Bandwidth, Bandwidths, IntervalEdge, PowerPeak};
