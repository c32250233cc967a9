//! Options of branches of periodic orbits.

use crate::continuation_options;
use crate::error::Error;
use crate::options::defaults;
use jounce_analysis::{BranchOptions as TracerOptions, BranchSearch, OrbitMethodKind};
use jounce_model::plant::Plant;
use serde::{Deserialize, Serialize};

/// Number of harmonics at the start of harmonic balance.
const HARMONICS: usize = 64;

/// Method of computing orbits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OrbitMethod {
    /// Shooting with the exact flow: every contact law, every period.
    Shooting,
    /// Harmonics of the contact forces: contact laws with a finite force.
    HarmonicBalance,
}

/// Options of [`crate::Harvester::branch`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BranchOptions {
    /// The key and its range: KEY=FROM:TO, as in drive.shaker.frequency=4Hz:20Hz.
    #[arg(long, value_name = "KEY=FROM:TO")]
    pub over: String,
    /// Method of computing orbits.
    #[arg(long, value_enum, default_value = "shooting")]
    pub method: OrbitMethod,
    /// Harmonics of the drive at the start of harmonic balance; 64 by default. More are added until
    /// the tolerance is met.
    #[arg(long)]
    pub harmonics: Option<usize>,
    /// Relative tolerance of the integration that computes the orbits.
    #[arg(long, default_value = "5e-10")]
    pub tolerance: f64,
    /// Number of values of the key inside the range, at equal distances, at which integrations search for
    /// orbits; they find isolated branches. 0: only branches that cross an end of the range.
    #[arg(long, default_value_t = BranchSearch::DEFAULT_SEEDS)]
    pub seeds: usize,
    /// Longest period of a branch, in drive cycles; longer ones are omitted.
    #[arg(long, default_value_t = 12, value_parser = clap::value_parser!(u32).range(1..))]
    pub longest_period: u32,
    /// Level to find on the branches, in quotes, as in --level "mean_power=50 uW", "voltage.PATCH=5
    /// V", "strain.PATCH=3e-4" or "contact_force.STOP=2 N"; can be given several times.
    #[arg(long = "level", value_name = "QUANTITY=VALUE")]
    pub levels: Vec<String>,
    /// Largest step along a branch, in relative changes of the state or twentieths of the range.
    #[arg(long, default_value_t = TracerOptions::default().largest_step)]
    pub largest_step: f64,
    /// Limit on the work of continuation, in drive cycles of all orbits. Branches beyond it are
    /// counted, but not continued.
    #[arg(long, default_value_t = TracerOptions::default().budget)]
    pub budget: usize,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for BranchOptions {
    fn default() -> Self {
        defaults()
    }
}

impl BranchOptions {
    /// Returns the method of computing orbits.
    pub(super) fn orbit_method(&self) -> Result<OrbitMethodKind, Error> {
        let invalid = |harmonics, expected| Err(Error::option("harmonics", harmonics, expected));
        match (self.method, self.harmonics) {
            (_, Some(harmonics)) if !(4..=2048).contains(&harmonics) => {
                invalid(harmonics, "give a number from 4 to 2048")
            }
            (OrbitMethod::Shooting, Some(harmonics)) => invalid(
                harmonics,
                "shooting has no harmonics; choose harmonic-balance as `method`, or omit it",
            ),
            (OrbitMethod::Shooting, None) => Ok(OrbitMethodKind::Shooting),
            (OrbitMethod::HarmonicBalance, harmonics) => Ok(OrbitMethodKind::HarmonicBalance {
                harmonics: harmonics.unwrap_or(HARMONICS),
            }),
        }
    }

    /// Returns the options of the continuation.
    pub(super) fn tracer(&self, plant: &Plant) -> Result<TracerOptions, Error> {
        let largest_step = self.largest_step;
        if !(1e-3..=1.0).contains(&largest_step) {
            let expected = "give a number from 0.001 to 1";
            return Err(Error::option("largest_step", largest_step, expected));
        }
        if self.budget == 0 {
            return Err(Error::option("budget", 0, "it must be at least 1"));
        }
        Ok(TracerOptions {
            largest_step,
            budget: self.budget,
            levels: continuation_options::levels(&self.levels, plant)?,
            ..TracerOptions::default()
        })
    }
}
