//! Ensembles: many realisations of noise, and means with their intervals.

mod options;
mod report;
mod result;

pub use options::EnsembleOptions;
pub use result::{EnsembleDevice, EnsemblePatch, EnsembleResult, EnsembleStop, VoltageSpectrum};

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::on_threads;
use jounce_analysis::Ensemble;
use jounce_analysis::run::{RunPlan, Warning};

/// Largest number of rounds of members; then the interval is reported even if it is wider than
/// required.
const MAX_ROUNDS: usize = 100;

impl Harvester {
    /// Integrates realisations of the noise of the spec and estimates means with 95 % intervals.
    /// After a stop by the control the finished members are counted.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Analysis`] for a spec without noise or an integration that does
    /// not converge, and [`Error::Stopped`] where no member was finished.
    ///
    /// ```
    /// use jounce::{EnsembleOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/random-base/harvester.toml")?;
    /// let harvester = harvester.changed([("run.duration", "2 s"), ("run.average_over", "1 s")])?;
    /// let result = harvester.ensemble(&EnsembleOptions { members: 2, ..Default::default() })?;
    /// println!("{:.3e} W +- {:?} W", result.mean_power_w, result.mean_power_half_width_w);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn ensemble(&self, options: &EnsembleOptions) -> Result<EnsembleResult, Error> {
        options.check()?;
        let harvester = self.with_tolerance(options.tolerance)?;
        let base = harvester.model()?;
        let study = Ensemble {
            start: base.start(harvester.folder())?,
            base: &base,
            members: options.members,
            seed: options.seed,
            relative_width: options.relative_width,
            most_rounds: options.relative_width.map_or(1, |_| MAX_ROUNDS),
            with_spectrum: options.spectrum,
        };
        let found = on_threads(options.threads, || Ok(study.run()?))?;
        if found.members.is_empty() {
            return Err(Error::Stopped);
        }
        let plan = RunPlan::of(&base.spec.run, 0.0);
        let warnings = Warning::of_recordings(&base.spec, &plan);
        Ok(EnsembleResult::new(found, options.seed, warnings))
    }
}
