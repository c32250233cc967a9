//! Check and scale drawing of a harvester.

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_analysis::run::{RunPlan, Warning};
use jounce_data::recording::Issue;
use jounce_plot::Drawing;
use jounce_spec::Fault;
use serde::Serialize;

/// Result of a check.
#[derive(Debug, Clone, Serialize)]
pub struct CheckResult {
    /// True for a spec without faults.
    pub valid: bool,
    /// Faults of the spec with their places.
    pub faults: Vec<Fault>,
    /// Data-quality issues of the recordings that the drives use.
    pub issues: Vec<DriveIssue>,
    /// Warnings of a run that are known before its integration.
    pub warnings: Vec<Warning>,
}

/// Data-quality issue of the recording of a drive.
#[derive(Debug, Clone, Serialize)]
pub struct DriveIssue {
    /// Name of the drive.
    pub drive: String,
    /// The issue.
    pub issue: Issue,
}

impl CheckResult {
    /// Returns the result for a spec with faults.
    pub fn invalid(faults: Vec<Fault>) -> Self {
        Self {
            valid: false,
            faults,
            issues: Vec::new(),
            warnings: Vec::new(),
        }
    }
}

impl Harvester {
    /// Creates the model, which finds errors that no key shows alone, and lists the issues of
    /// recordings and the warnings that need no integration.
    ///
    /// # Errors
    /// [`Error::Analysis`] for a structure or circuit without a solution.
    ///
    /// ```
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = jounce::Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// assert!(harvester.check()?.valid);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn check(&self) -> Result<CheckResult, Error> {
        let model = self.model()?;
        let plan = RunPlan::of(&model.spec.run, 0.0);
        let of_drive = |(drive, issue): (&str, &Issue)| DriveIssue {
            drive: drive.to_owned(),
            issue: issue.clone(),
        };
        Ok(CheckResult {
            valid: true,
            faults: Vec::new(),
            issues: self.issues().map(of_drive).collect(),
            warnings: Warning::of_model(&model.spec, &model.kernel.plant, &plan),
        })
    }

    /// Draws the harvester to scale, also one without a solution.
    ///
    /// ```
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = jounce::Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// assert!(harvester.drawing("Harvester").to_svg().contains("Harvester"));
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn drawing(&self, title: &str) -> Drawing {
        jounce_plot::show::drawing(title, self.spec())
    }
}
