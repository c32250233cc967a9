//! Results of an integration: trajectory, samples, time integrals, statistics and energies.

pub(crate) mod energies;
mod sampling;
pub(crate) mod statistics;
mod time_integral;
pub(crate) mod trajectory;
