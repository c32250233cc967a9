//! Options of basins of attraction.

use crate::error::Error;
use crate::options::{check_tolerance, defaults, refuse_changed};
use jounce_analysis::{Cloud, Grid, InitialStates, Recognition};
use serde::{Deserialize, Serialize};

/// Largest number of starts of a cloud.
const MAX_STARTS: usize = 100_000_000;

/// Options of [`crate::Harvester::basins`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BasinsOptions {
    /// Number of starts.
    #[arg(long, default_value_t = 200)]
    pub starts: usize,
    /// Seed of the random numbers that draw the cloud; another seed draws other starts.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Size of the cloud at the stop, in gaps (or in steady amplitudes, if larger).
    #[arg(long, default_value_t = 10.0)]
    pub spread: f64,
    /// Side of a plane or box of starts instead of the cloud, with its number of values; once for
    /// each side: displacement=-5mm:5mm:21x, velocity=-1m/s:1m/s:21x or voltage=-10V:10V:5x.
    #[arg(long, value_name = "SIDE=FROM:TO:Nx", allow_hyphen_values = true)]
    pub grid: Vec<String>,
    /// Relative tolerance of the integration.
    #[arg(long, default_value = "1e-8")]
    pub tolerance: f64,
    /// Longest period of an attractor, in drive cycles.
    #[arg(long, default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..))]
    pub longest_period: u32,
    /// Number of drive cycles after which a start without a proven attractor counts as chaos or
    /// undecided.
    #[arg(long, default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub max_cycles: u32,
    /// Number of threads; by default one per core. The result does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

impl Default for BasinsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl BasinsOptions {
    /// Returns the initial states for a harvester with so many stops.
    pub(super) fn initial_states(&self, stops: usize) -> Result<InitialStates, Error> {
        if !self.grid.is_empty() {
            refuse_changed(
                self,
                &["starts", "seed", "spread"],
                "it applies to a cloud of starts; omit it, or omit `grid`",
            )?;
            return Ok(InitialStates::Grid(Grid::read(&self.grid, stops)?));
        }
        let &Self {
            starts,
            seed,
            spread,
            ..
        } = self;
        Ok(InitialStates::Cloud(cloud(starts, seed, spread)?))
    }

    /// Returns how the starts are drawn, in words.
    ///
    /// ```
    /// let text = jounce::BasinsOptions { starts: 20, ..Default::default() }.starts_text();
    /// assert!(text.starts_with("20 random starts (seed 1)"), "{text}");
    /// ```
    pub fn starts_text(&self) -> String {
        if !self.grid.is_empty() {
            return format!("starts on a grid: {}", self.grid.join(", "));
        }
        let &Self {
            starts,
            seed,
            spread,
            ..
        } = self;
        format!(
            "{starts} random starts (seed {seed}): displacement and velocity of every mode are uniform, up to a motion of {spread} gaps at the stop (or steady amplitudes, if larger) at the frequency of the drive"
        )
    }

    /// Returns the options of the recognition of attractors.
    pub(super) fn recognition(&self) -> Result<Recognition, Error> {
        check_tolerance(self.tolerance)?;
        for (option, value) in [
            ("longest_period", self.longest_period),
            ("max_cycles", self.max_cycles),
        ] {
            if value == 0 {
                return Err(Error::option(option, value, "it must be at least 1"));
            }
        }
        Ok(Recognition {
            longest_period: self.longest_period,
            max_cycles: self.max_cycles,
            ..Recognition::at(self.tolerance)
        })
    }
}

/// Returns a cloud of starts.
///
/// # Errors
/// [`Error::Option`].
pub(crate) fn cloud(starts: usize, seed: u64, spread: f64) -> Result<Cloud, Error> {
    if !(1..=MAX_STARTS).contains(&starts) {
        let expected = format!("it must be from 1 to {MAX_STARTS}");
        return Err(Error::option("starts", starts, expected));
    }
    if !(spread > 0.0 && spread.is_finite()) {
        return Err(Error::option("spread", spread, "it must be greater than 0"));
    }
    Ok(Cloud {
        starts,
        seed,
        spread,
    })
}
