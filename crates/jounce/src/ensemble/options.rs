//! Options of an ensemble.

use crate::error::Error;
use crate::options::defaults;
use jounce_analysis::Ensemble;
use serde::{Deserialize, Serialize};

/// Largest number of members of a round.
const MAX_MEMBERS: usize = 1_000_000;
/// Smallest number of members of a spectrum.
const MIN_SPECTRUM_MEMBERS: usize = 2;

/// Options of [`crate::Harvester::ensemble`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EnsembleOptions {
    /// Number of realisations; with a relative width, number per round.
    #[arg(long, default_value_t = Ensemble::DEFAULT_MEMBERS)]
    pub members: usize,
    /// Seed of the realisations.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Adds rounds of members until the half width of the 95 % interval is at most this share of
    /// the mean power.
    #[arg(long, value_name = "WIDTH")]
    pub relative_width: Option<f64>,
    /// Estimates the power spectral density of every voltage and its bandwidth; slower, and needs
    /// at least two members.
    #[arg(long)]
    pub spectrum: bool,
    /// Required relative error of the response; overrides run.tolerance.
    #[arg(long)]
    pub tolerance: Option<f64>,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for EnsembleOptions {
    fn default() -> Self {
        defaults()
    }
}

impl EnsembleOptions {
    /// Checks the numbers.
    pub(super) fn check(&self) -> Result<(), Error> {
        let members = self.members;
        if !(1..=MAX_MEMBERS).contains(&members) {
            let expected = format!("it must be from 1 to {MAX_MEMBERS}");
            return Err(Error::option("members", members, expected));
        }
        if self.spectrum && members < MIN_SPECTRUM_MEMBERS {
            let expected = "a spectrum needs at least 2 to estimate the scatter of the density";
            return Err(Error::option("members", members, expected));
        }
        match self.relative_width {
            Some(width) if !(width > 0.0 && width < 1.0) => {
                let expected = "it must be between 0 and 1";
                Err(Error::option("relative_width", width, expected))
            }
            _ => Ok(()),
        }
    }
}
