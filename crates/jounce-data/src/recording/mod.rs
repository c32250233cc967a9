//! Recordings: channels in SI units over time or frequency, with their data-quality issues.
//!
//! Every conversion, gap, clipping or resampling is recorded as an [`Issue`] with its count and
//! first position.
mod channel;
mod choose;
mod grid;
mod inspect;
mod issue;
mod quantity;
mod recorded;
mod series;
mod unit;
mod unit_spelling;

pub use channel::Channel;
pub use choose::{ChannelError, ChannelHead, choose_channel, find_channel};
pub(crate) use grid::gaps::{StampsWithGaps, typical_step};
pub(crate) use grid::stamps::Stamped;
pub use grid::{Grid, GridError, Over};
pub(crate) use inspect::complex_sizes::sizes_with;
pub use inspect::{Sizes, inspect};
pub(crate) use inspect::{inspect_samples, may_be_counts};
pub use issue::{Issue, IssueKind, IssuePlace};
pub use quantity::Quantity;
pub use recorded::{NoChannel, Recording};
pub use series::{PIECE, Series};
pub use unit::Unit;

pub use jounce_units::STANDARD_GRAVITY_M_S2;
pub(crate) use unit_spelling::unbracketed;
