//! Sweeps: the model at every value of a key.

mod options;
mod report;
mod result;

pub use options::{SweepOptions, SweepOrder};
pub use result::{SweepPoint, SweepResult};

use crate::error::Error;
use crate::harvester::Harvester;
use crate::journal;
use crate::options::{key_range, on_threads};
use jounce_analysis::{Journal, Sweep};
use jounce_spec::KeyRange;
use std::path::Path;

/// Name in the keys of journals.
const QUESTION: &str = "sweep";

impl Harvester {
    /// Integrates the model at every value of a key until it has settled. A stepped sweep starts
    /// each point from the last state of the point before, and so follows a branch of responses.
    /// After a stop by the control the result holds the finished points.
    ///
    /// # Errors
    /// [`Error::Range`] for an unknown key or an invalid range, [`Error::Analysis`] for an
    /// integration that does not converge.
    ///
    /// ```
    /// use jounce::{Harvester, SweepOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let harvester = harvester.changed([("run.duration", "2 s"), ("run.average_over", "1 s")])?;
    /// let result = harvester.sweep(&SweepOptions {
    ///     over: "drive.shaker.frequency=10Hz:11Hz:0.5Hz".to_owned(),
    ///     fixed_duration: true,
    ///     ..Default::default()
    /// })?;
    /// assert_eq!(result.points.len(), 3);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn sweep(&self, options: &SweepOptions) -> Result<SweepResult, Error> {
        self.run_sweep(options, None)
    }

    /// Sweeps as [`Harvester::sweep`], stores each finished point in a journal, and takes the points
    /// that the journal holds from there. [`Journal::finish`] removes the journal of a complete
    /// sweep.
    ///
    /// # Errors
    /// As [`Harvester::sweep`], and [`Error::Analysis`] for a journal that cannot be written.
    ///
    /// ```no_run
    /// use jounce::{Harvester, SweepOptions};
    /// let harvester = Harvester::read("harvester.toml")?;
    /// let over = "drive.shaker.frequency=4Hz:20Hz:0.1Hz".to_owned();
    /// let options = SweepOptions { over, ..Default::default() };
    /// let journal = harvester.sweep_journal(&options, "cache")?;
    /// let result = harvester.sweep_with_journal(&options, &journal)?;
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn sweep_with_journal(
        &self,
        options: &SweepOptions,
        journal: &Journal,
    ) -> Result<SweepResult, Error> {
        self.run_sweep(options, Some(journal))
    }

    /// Opens the journal of a sweep in a folder. Its points count as done in the progress of the
    /// control.
    ///
    /// # Errors
    /// [`Error::Range`] for an unknown key or an invalid range, [`Error::Journal`].
    pub fn sweep_journal(
        &self,
        options: &SweepOptions,
        folder: impl AsRef<Path>,
    ) -> Result<Journal, Error> {
        let (harvester, _) = self.swept(options)?;
        let options = SweepOptions {
            threads: None,
            ..options.clone()
        };
        let journal: Journal = journal::open(folder.as_ref(), &harvester, (QUESTION, &options))?;
        journal.found().iter().for_each(|_| self.control().count());
        Ok(journal)
    }

    fn run_sweep(
        &self,
        options: &SweepOptions,
        journal: Option<&Journal>,
    ) -> Result<SweepResult, Error> {
        let (harvester, range) = self.swept(options)?;
        let study = Sweep {
            spec: harvester.spec(),
            range: &range,
            direction: order(options, &range).into(),
            fixed_duration: options.fixed_duration,
            folder: harvester.folder().to_path_buf(),
        };
        let control = self.control();
        let work = || Ok(study.run(journal, control, &|_| ())?);
        let points = on_threads(options.threads, work)?;
        Ok(SweepResult::new(&study, points))
    }

    /// Returns the harvester with the tolerance of a sweep, and the values of its key.
    fn swept(&self, options: &SweepOptions) -> Result<(Self, KeyRange), Error> {
        let harvester = self.with_tolerance(options.tolerance)?;
        let range = key_range(&harvester, "over", &options.over)?;
        if let ("run.tolerance", Some(tolerance)) = (range.key().path(), options.tolerance) {
            let expected = "`over` gives the values of run.tolerance; omit one of them";
            return Err(Error::option("tolerance", tolerance, expected));
        }
        Ok((harvester, range))
    }
}

/// Returns the order of the points; those with other numbers of modes cannot start from each other.
fn order(options: &SweepOptions, range: &KeyRange) -> SweepOrder {
    match range.key().path() {
        "reduction.modes" => SweepOrder::Independent,
        _ => options.direction,
    }
}
