//! Bifurcation curves in two keys: folds, period doublings, tori, grazings, levels and peaks.

mod options;
mod report;
mod result;

pub use options::BifurcationsOptions;
pub use result::{BifurcationCurve, BifurcationsResult};

use crate::continuation_options;
use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::on_threads;
use jounce_analysis::{BifurcationSearch, BranchOptions};

impl Harvester {
    /// Continues bifurcation curves in two keys: folds, period doublings, tori and grazings, the
    /// levels, and the peaks of mean power. After a stop by the control the result holds the
    /// finished curves.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Range`] for an unknown key, [`Error::Analysis`] and
    /// [`Error::Orbit`] for drives without a common period, and [`Error::Stopped`] where no curve
    /// was finished.
    ///
    /// ```
    /// use jounce::{BifurcationsOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let result = harvester.bifurcations(&BifurcationsOptions {
    ///     over: "drive.shaker.frequency=12.5Hz:12.7Hz".to_owned(),
    ///     against: "stop.tip.gap=0.99mm:1.01mm".to_owned(),
    ///     seeds: 0,
    ///     longest_period: 1,
    ///     peaks: false,
    ///     ..Default::default()
    /// })?;
    /// assert!(result.curves.iter().any(|curve| curve.name() == "fold"));
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn bifurcations(&self, options: &BifurcationsOptions) -> Result<BifurcationsResult, Error> {
        let &BifurcationsOptions {
            tolerance,
            seeds,
            longest_period,
            peaks,
            ..
        } = options;
        continuation_options::check_search(tolerance, seeds, longest_period)?;
        let (key, range) = continuation_options::range(self, "over", &options.over)?;
        let (key_2, range_2) = continuation_options::range(self, "against", &options.against)?;
        if key.path() == key_2.path() {
            let expected = "`over` has this key too; give two different keys";
            return Err(Error::option("against", &options.against, expected));
        }
        let base = self.model()?;
        let search = BifurcationSearch {
            base: &base,
            keys: [&key, &key_2],
            ranges: [range, range_2],
            tolerance,
            seeds,
            longest_period,
            peaks,
        };
        let branch_options = BranchOptions {
            levels: continuation_options::levels(&options.levels, &base.kernel.plant)?,
            ..BranchOptions::default()
        };
        let curves = on_threads(options.threads, || Ok(search.run_with(&branch_options)?))?;
        if curves.is_empty() && self.control().is_stopped() {
            return Err(Error::Stopped);
        }
        Ok(BifurcationsResult {
            key: key.path().to_owned(),
            unit: key.unit(),
            key_2: key_2.path().to_owned(),
            unit_2: key_2.unit(),
            curves: curves.into_iter().map(BifurcationCurve::new).collect(),
            note: options.note(),
            options: options.clone(),
        })
    }
}
