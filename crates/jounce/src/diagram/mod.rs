//! Bifurcation diagrams: Poincare sections over the values of a key, by integration.

mod options;
mod report;
mod result;
mod tables;

pub use options::{DiagramDirection, DiagramOptions};
pub use result::{DiagramPoint, DiagramResult, SectionPoint};

use crate::branch::Branch;
use crate::continuation_options;
use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::{key_range, on_threads};
use crate::{journal, periodic};
use jounce_analysis as analysis;
use jounce_analysis::{AnalysisError, BranchSearch, Diagram, DiagramOrder};
use jounce_analysis::{AttractorTracks, Journal, Model, OrbitMethodKind, Parameter};
use jounce_spec::KeyRange;
use std::path::Path;

/// Journal of the finished runs of a diagram.
pub type DiagramJournal = Journal<analysis::DiagramPoint>;

/// Name in the keys of journals.
const QUESTION: &str = "diagram";

/// Width of the range of a single value 0.
const MIN_WIDTH: f64 = 1e-12;

impl Harvester {
    /// Computes a bifurcation diagram: the state at the start of each drive cycle over increasing
    /// values of a key, and the branches over the same range. After a stop by the control the
    /// result holds the finished runs.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Range`] for an unknown key or an invalid value,
    /// [`Error::DriveAtRest`], [`Error::Journal`], and [`Error::Stopped`] where no run was
    /// finished.
    ///
    /// ```
    /// use jounce::{DiagramOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let result = harvester.diagram(&DiagramOptions {
    ///     over: "drive.shaker.frequency=12Hz:13Hz:3x".to_owned(),
    ///     branches: false,
    ///     ..Default::default()
    /// })?;
    /// assert_eq!(result.points.len(), 6);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn diagram(&self, options: &DiagramOptions) -> Result<DiagramResult, Error> {
        self.run_diagram(options, None)
    }

    /// Computes a diagram as [`Harvester::diagram`], stores each finished run in a journal, and
    /// takes the runs that the journal holds from there. [`Journal::finish`] removes the journal of
    /// a complete diagram.
    ///
    /// # Errors
    /// As [`Harvester::diagram`], and [`Error::Analysis`] for a journal that cannot be written.
    ///
    /// ```no_run
    /// use jounce::{DiagramOptions, Harvester};
    /// let harvester = Harvester::read("harvester.toml")?;
    /// let over = "drive.shaker.frequency=4Hz:20Hz:0.1Hz".to_owned();
    /// let options = DiagramOptions { over, ..Default::default() };
    /// let journal = harvester.diagram_journal(&options, "cache")?;
    /// let result = harvester.diagram_with_journal(&options, &journal)?;
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn diagram_with_journal(
        &self,
        options: &DiagramOptions,
        journal: &DiagramJournal,
    ) -> Result<DiagramResult, Error> {
        self.run_diagram(options, Some(journal))
    }

    /// Opens the journal of a diagram in a folder. Its runs count as done in the progress of the
    /// control.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Journal`].
    pub fn diagram_journal(
        &self,
        options: &DiagramOptions,
        folder: impl AsRef<Path>,
    ) -> Result<DiagramJournal, Error> {
        self.diagram_range(options)?;
        // The runs do not depend on the other options.
        let options = DiagramOptions {
            branches: true,
            longest_period: None,
            threads: None,
            ..options.clone()
        };
        let journal: DiagramJournal = journal::open(folder.as_ref(), self, (QUESTION, &options))?;
        let found = journal.found().len();
        self.control().expect(found);
        (0..found).for_each(|_| self.control().count());
        Ok(journal)
    }

    fn run_diagram(
        &self,
        options: &DiagramOptions,
        journal: Option<&DiagramJournal>,
    ) -> Result<DiagramResult, Error> {
        let (longest_period, order) = (options.longest_period()?, options.order()?);
        let &DiagramOptions {
            cycles, tolerance, ..
        } = options;
        let range = self.diagram_range(options)?;
        let values = range.values();
        let (low, high) = (values[0], values[values.len() - 1]);
        let base = self.model()?;
        periodic::check_drives(&base.kernel.plant, "a diagram")?;
        let width = match high > low {
            true => high - low,
            false => high.abs().max(MIN_WIDTH),
        };
        let parameter = Parameter::new(&base, range.key(), width);
        let study = Diagram {
            base: &base,
            parameter: &parameter,
            values,
            order,
            cycles,
            tolerance,
        };
        on_threads(options.threads, || {
            let points = study.run(journal, &|_| ())?;
            let is_stopped = || self.control().is_stopped();
            if points.is_empty() && is_stopped() {
                return Err(Error::Stopped);
            }
            let tracks = match order {
                DiagramOrder::Starts(_) if !is_stopped() => Some(study.history(&points)?),
                _ => None,
            };
            let search = BranchSearch {
                base: &base,
                parameter: &parameter,
                range: (low, high),
                method: OrbitMethodKind::Shooting,
                tolerance,
                seeds: options::SEEDS,
                longest_period,
            };
            let branches = match options.branches && high > low && !is_stopped() {
                true => search.run()?,
                false => Vec::new(),
            };
            // Tracks of interrupted runs are incomplete.
            let tracks = tracks.filter(|_| !is_stopped());
            let branches = (&base, &parameter, branches.as_slice());
            DiagramResult::new(study.len(), &points, tracks, branches)
        })
    }

    /// Returns the key and its increasing values.
    fn diagram_range(&self, options: &DiagramOptions) -> Result<KeyRange, Error> {
        let range = key_range(self, "over", &options.over)?;
        continuation_options::check_continuous(range.key(), "over", &options.over)?;
        if range.values().windows(2).any(|pair| pair[0] >= pair[1]) {
            let expected = "the values of a diagram must increase";
            return Err(Error::option("over", &options.over, expected));
        }
        Ok(range)
    }
}

impl DiagramResult {
    fn new(
        expected: usize,
        points: &[analysis::DiagramPoint],
        tracks: Option<AttractorTracks>,
        (base, parameter, branches): (&Model, &Parameter<'_>, &[analysis::Branch]),
    ) -> Result<Self, Error> {
        let displacement_m = branches
            .iter()
            .map(|branch| displacement_m(base, parameter, branch));
        let branch = |branch| Branch::new(branch, Vec::new(), None);
        Ok(Self {
            key: parameter.key().path().to_owned(),
            unit: parameter.key().unit(),
            points: located(points, tracks.as_ref()),
            attractors: tracks.map(|tracks| tracks.attractors),
            expected,
            branch_displacement_m: displacement_m.collect::<Result<_, _>>()?,
            branches: branches.iter().map(branch).collect(),
        })
    }
}

/// Returns the points with their attractors, where known.
fn located(
    points: &[analysis::DiagramPoint],
    tracks: Option<&AttractorTracks>,
) -> Vec<DiagramPoint> {
    let attractor = |index: usize| {
        let tracks = tracks?;
        Some(tracks.attractors[tracks.homes[index]?].id.clone())
    };
    let points = points.iter().enumerate();
    points
        .map(|(index, point)| DiagramPoint::new(point, attractor(index)))
        .collect()
}

/// Returns the displacement at the start of each drive cycle of each point of a branch, m.
fn displacement_m(
    base: &Model,
    parameter: &Parameter<'_>,
    branch: &analysis::Branch,
) -> Result<Vec<Vec<f64>>, AnalysisError> {
    let of_point = |point: &analysis::BranchPoint| {
        let section =
            analysis::SectionPoint::of_orbit(base, parameter, point.parameter, &point.orbit)?;
        Ok(section.iter().map(|point| point.displacement_m).collect())
    };
    branch.points.iter().map(of_point).collect()
}
