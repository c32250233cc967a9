//! Tables and figures of the paper, computed again.

pub(super) mod assumptions;
mod coexistence;
pub(super) mod frequency_responses;
pub(super) mod orbits;
pub(super) mod power_over_frequency;
pub(super) mod power_over_resistance;
pub(super) mod runs;
pub(super) mod stepped;
pub(super) mod table_2;
pub(super) mod voltage;
