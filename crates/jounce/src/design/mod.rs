//! Design: values of keys with the largest power within limits.

mod figure;
mod options;
mod report;

pub use options::DesignOptions;

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::on_threads;
use jounce_analysis::Journal;
use jounce_control::Control;
use jounce_design::{Condition, DesignOutcome, Journaled, OnImprovement, Problem, design};
use jounce_io::store;
use jounce_spec::Spec;
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;

/// Table of a spec that says how long to integrate, which is no condition of a harvester.
const RUN: &str = "run.";

/// Journal of the evaluations of a design.
pub type DesignJournal = Journal<Journaled>;

/// Best design with what is known of it, and its harvester.
#[derive(Debug, Clone, Serialize)]
pub struct DesignResult {
    /// Result of the search.
    #[serde(flatten)]
    pub outcome: DesignOutcome,
    /// Harvester of the best design, under the drive of the condition if there is only one.
    #[serde(skip)]
    pub harvester: Harvester,
    /// Conditions in words; empty for a design with one.
    #[serde(skip)]
    conditions: Vec<String>,
}

/// A design problem: a spec, its free keys, the goal, the limits, the conditions and the
/// tolerances.
#[derive(Debug, Clone)]
pub struct Design {
    problem: Arc<Problem>,
    control: Control,
}

impl Harvester {
    /// Reads a design problem of this harvester from the text of its file. A key `spec` in it, relative
    /// to the folder of this harvester, must name the same spec.
    ///
    /// # Errors
    /// [`Error::Design`] with all faults.
    ///
    /// ```
    /// use jounce::{DesignOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let design = harvester.design(
    ///     "evaluations = 60\n[free]\n\"circuit.load.resistance\" = \"10kohm:3Mohm:log\"\n\
    ///      [goal]\nmaximise = \"expected-power\"\nstarts = 10",
    /// )?;
    /// let result = design.run(&DesignOptions::default())?;
    /// let best = &result.outcome.best;
    /// println!("{:?}: {} W", best.set, best.expected_power_w);
    /// # assert!(best.expected_power_w > result.outcome.before.expected_power_w);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn design(&self, text: &str) -> Result<Design, Error> {
        self.design_in(text, self.folder())
    }

    /// Reads a design problem as [`Harvester::design`], from the text of a file in a folder, to which
    /// the key `spec` is relative.
    ///
    /// # Errors
    /// As [`Harvester::design`].
    pub fn design_in(&self, text: &str, folder: impl AsRef<Path>) -> Result<Design, Error> {
        let file = self.file().clone();
        let problem = Problem::with_spec(file, self.folder(), text, folder.as_ref())?;
        Ok(Design::of(problem).with_control(self.control()))
    }
}

impl Design {
    /// Reads the file of a design (TOML); the path of its spec is relative to its folder.
    ///
    /// # Errors
    /// [`Error::Design`] for a file that cannot be read, or with all faults.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Ok(Self::of(Problem::read(path.as_ref())?))
    }

    fn of(problem: Problem) -> Self {
        Self {
            problem: Arc::new(problem),
            control: Control::default(),
        }
    }

    /// Returns a copy whose computations poll a control: it reports progress and stops them.
    #[must_use]
    pub fn with_control(&self, control: &Control) -> Self {
        Self {
            control: control.clone(),
            ..self.clone()
        }
    }

    /// Returns the spec of the design.
    pub fn spec(&self) -> &Spec {
        &self.problem.spec
    }

    /// Returns the SHA-256 of the text and the spec.
    pub fn hash_hex(&self) -> &str {
        self.problem.hash_hex()
    }

    /// Searches for the best design and examines it. After a stop by the control, the best design
    /// so far is the result.
    ///
    /// # Errors
    /// [`Error::Option`] for no evaluations, [`Error::Design`] where no design can be evaluated.
    pub fn run(&self, options: &DesignOptions) -> Result<DesignResult, Error> {
        self.search(options, None, None)
    }

    /// Searches as [`Design::run`], and calls `improved` with each better design as soon as it is
    /// found. The result does not depend on it.
    ///
    /// # Errors
    /// As [`Design::run`].
    pub fn run_and_report(
        &self,
        options: &DesignOptions,
        improved: OnImprovement<'_>,
    ) -> Result<DesignResult, Error> {
        self.search(options, None, Some(improved))
    }

    /// Searches as [`Design::run`], and keeps every evaluation in a journal, from which an
    /// interrupted search continues. [`Journal::finish`] removes the journal of a complete search.
    ///
    /// # Errors
    /// As [`Design::run`], and [`Error::Design`] for a journal that cannot be written.
    pub fn run_with_journal(
        &self,
        options: &DesignOptions,
        journal: &DesignJournal,
    ) -> Result<DesignResult, Error> {
        self.search(options, Some(journal), None)
    }

    /// Opens the journal of a search in a folder.
    ///
    /// # Errors
    /// [`Error::Journal`].
    pub fn journal(
        &self,
        options: &DesignOptions,
        folder: impl AsRef<Path>,
    ) -> Result<DesignJournal, Error> {
        let problem = self.problem_with(options)?;
        let key = format!("{}-{}", problem.hash_hex(), problem.seed);
        Ok(Journal::open(folder.as_ref(), &key)?)
    }

    fn search(
        &self,
        options: &DesignOptions,
        journal: Option<&DesignJournal>,
        improved: Option<OnImprovement<'_>>,
    ) -> Result<DesignResult, Error> {
        let problem = self.problem_with(options)?;
        let work = || Ok(design(&problem, &self.control, journal, improved)?);
        let outcome = on_threads(options.threads, work)?;
        let given = Harvester::of(problem.file.clone(), problem.folder.clone())?;
        let mut values: Vec<(String, String)> = Vec::new();
        if let [condition] = problem.conditions.as_slice() {
            let own = settings(&problem, condition);
            values.extend(own.filter(|(key, _)| !key.starts_with(RUN)));
        }
        values.extend(outcome.best.set.clone());
        let pairs = values.iter();
        let harvester = given.changed(pairs.map(|(key, value)| (key.as_str(), value.as_str())))?;
        let conditions = match problem.conditions.as_slice() {
            [_] => Vec::new(),
            several => several
                .iter()
                .map(|one| condition_text(&problem, one))
                .collect(),
        };
        Ok(DesignResult {
            outcome,
            harvester,
            conditions,
        })
    }

    /// Returns the problem with the seed and the budget of the options.
    fn problem_with(&self, options: &DesignOptions) -> Result<Problem, Error> {
        let mut problem = (*self.problem).clone();
        problem.seed = options.seed.unwrap_or(problem.seed);
        if let Some(evaluations) = options.evaluations {
            if evaluations == 0 {
                let expected = format!("it must be from 1 to {}", u32::MAX);
                return Err(Error::option("evaluations", evaluations, expected));
            }
            problem.evaluations = evaluations as usize;
        }
        Ok(problem)
    }
}

impl DesignResult {
    /// Writes the spec of the best design. With several conditions, a comment at its top lists them:
    /// the drive of the spec is none of theirs.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_best(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let mut text = String::new();
        if !self.conditions.is_empty() {
            text.push_str("# Best design for these conditions; the values below are those of the spec as given:\n");
            let lines = self.conditions.iter();
            text.extend(lines.map(|condition| format!("#   {condition}\n")));
            text.push('\n');
        }
        text.push_str(&self.harvester.text());
        Ok(store::write(path.as_ref(), text.as_bytes())?)
    }
}

/// Returns the keys of a condition with their values as text.
fn settings<'p>(
    problem: &'p Problem,
    condition: &'p Condition,
) -> impl Iterator<Item = (String, String)> + 'p {
    let numbers = condition.values.iter().map(|(key, value)| {
        let text = format!("{value:?} {}", key.unit());
        (key.path().to_owned(), text.trim_end().to_owned())
    });
    problem.changes[condition.change]
        .iter()
        .cloned()
        .chain(numbers)
}

/// Returns a condition in words.
fn condition_text(problem: &Problem, condition: &Condition) -> String {
    let values = settings(problem, condition).map(|(key, value)| format!("{key} = {value}"));
    let values: Vec<String> = values.collect();
    format!("{}; weight {}", values.join(", "), condition.weight)
}
