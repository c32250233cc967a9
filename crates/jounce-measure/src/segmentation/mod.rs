//! A long record under a harmonic drive, cut into stretches of one solution each.
//!
//! The record is cut into blocks of six drive cycles. The features of a block are its rms and its amplitudes at the orders 1/3, 1/2, 1, 2
//! and 3 of the drive. The stretches are the partition of the blocks that minimises
//!
//! ```text
//! sum over stretches and features of n ln v + e / (s^2 v)  +  c ln(B) per stretch,   v = max(1, e / (n s^2))
//! ```
//!
//! with `e` what a mean and a trend leave of the `n` blocks of a stretch, and `s` the noise of each feature, from the median difference of
//! neighbouring blocks: a change counts only where it is larger than the noise, and larger than 5 % of the record's largest feature. A stretch that is
//! irregular, as a start or chaos, has its own larger noise, and one whose size changes slowly its trend; neither is cut. The optimum is found
//! exactly, by dynamic programming.
//!
//! Neighbouring stretches whose amplitudes, freed of noise, are equal, or drift, are joined again, and the reason is told.
//!
//! The period of a stretch is the smallest `n` up to 12 such that the record folded at `n` cycles leaves as little as folded at any other.
//!
//! [`match_segments`] names, for a stretch, the solution of a model whose voltage it shows.
//!
//! Source: for the cost R. Killick, P. Fearnhead, I. Eckley, Optimal detection of changepoints, J. Am. Stat. Assoc. 107 (2012) 1590; B. Jackson et al., An algorithm for optimal partitioning of data on an interval, IEEE Signal Process. Lett. 12 (2005) 105.
mod features;
mod matching;
mod merging;
mod partition;
mod period;
mod section;
mod segments;
mod shift;

pub use matching::{Candidate, SegmentMatch, SegmentMatches, match_segments};
pub use merging::{MergeReason, MergedChange};
pub use period::{MAX_PERIOD_CYCLES, RepetitionPeriod, period};
pub use section::{Section, section};
pub use segments::{RecordSegment, Segmentation, SegmentationError, regimes, regimes_watched};
