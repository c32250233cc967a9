//! Segments a long record under a harmonic drive by solution.
//!
//! The record is cut into blocks of six drive cycles. The features of a block are its RMS and its
//! amplitudes at the orders 1/3, 1/2, 1, 2 and 3 of the drive. The segments are the partition of
//! the blocks that minimises
//!
//! ```text
//! sum over segments and features of n ln v + e / (s^2 v)  +  c ln(B) per segment,   v = max(1, e / (n s^2))
//! ```
//!
//! Here `e` is the residual of a mean and a trend over the `n` blocks of a segment. The noise `s`
//! of each feature is from the median difference of neighbouring blocks. A change counts only if it
//! exceeds the noise, and 5 % of the record's largest feature. An irregular segment, such as a
//! transient or chaos, has a larger noise of its own, and one with a slowly changing amplitude has
//! a trend; neither is cut. The exact optimum is found by dynamic programming.
//!
//! Neighbouring segments whose noise-corrected amplitudes are equal, or drift, are merged, and the
//! reason is reported.
//!
//! The period of a segment is the smallest `n` up to 12 such that the record folded at `n` cycles
//! leaves as small a residual as at any other.
//!
//! [`match_segments`] finds the solution of a model whose voltage matches a segment.
//!
//! Source: for the cost R. Killick, P. Fearnhead, I. Eckley, Optimal detection of changepoints, J.
//! Am. Stat. Assoc. 107 (2012) 1590; B. Jackson et al., An algorithm for optimal partitioning of
//! data on an interval, IEEE Signal Process. Lett. 12 (2005) 105.
mod cycles;
mod features;
mod matching;
mod merging;
mod partition;
mod period;
mod section;
mod segment_features;
mod segments;
mod shift;

pub use matching::{Candidate, SegmentMatch, SegmentMatches, match_segments};
pub use merging::{MergeReason, MergedChange};
pub use period::{MAX_PERIOD_CYCLES, RepetitionPeriod, period};
pub use section::{Section, section};
pub use segments::{RecordSegment, Segmentation, SegmentationError, segments, segments_watched};
