//! The paper's harvester, its variants, and its cases of drive and load.

use super::ReproduceError;
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_control::Control;
use jounce_dynamics::Kernel;
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes;
use jounce_spec::{Spec, SpecFile};

const PAPER: &str = include_str!("../specs/harvester.toml");

/// Returns the spec of the paper's harvester with some keys set.
///
/// # Errors
/// The spec does not allow a key or value.
pub fn paper_spec(settings: &[(&str, &str)]) -> Result<Spec, ReproduceError> {
    Ok(paper_file(settings)?.spec()?)
}

/// Returns the file of the paper's harvester with some keys set.
///
/// # Errors
/// A key does not exist.
pub fn paper_file(settings: &[(&str, &str)]) -> Result<SpecFile, ReproduceError> {
    let mut file = SpecFile::from_text(PAPER);
    for (key, value) in settings {
        file.set(key, value)?;
    }
    Ok(file)
}

/// Harvester with its modes. Cases of drive and load reuse the solution of the structure.
pub(super) struct PaperHarvester {
    pub spec: Spec,
    pub system: System,
    /// Cancels the runs, and counts the runs of the figures.
    pub control: Control,
}

/// Case of one drive and one load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PaperCase {
    pub frequency_hz: f64,
    pub amplitude_n: f64,
    pub resistance_ohm: f64,
}

/// Load of figures 6 and 7, ohm.
pub(super) const MEGOHM: f64 = 1e6;

/// Case of figure 7; figure 8 varies its load.
pub(super) const ABOVE_RESONANCE: PaperCase = PaperCase {
    frequency_hz: 13.0,
    amplitude_n: 200.0,
    resistance_ohm: MEGOHM,
};

/// Case of figure 9, at the load of figure 7.
pub(super) const BELOW_RESONANCE: PaperCase = PaperCase {
    frequency_hz: 6.0,
    amplitude_n: 50.0,
    resistance_ohm: MEGOHM,
};

impl PaperHarvester {
    /// Builds the paper's harvester with some keys set; a control can cancel its runs.
    pub fn with(settings: &[(String, String)], control: &Control) -> Result<Self, ReproduceError> {
        let spec = Self::spec(settings)?;
        let system = System::assemble(&spec, modes(&spec)?)?;
        Ok(Self {
            spec,
            system,
            control: control.clone(),
        })
    }

    /// Returns the spec with some keys set.
    pub fn spec(settings: &[(String, String)]) -> Result<Spec, ReproduceError> {
        let settings: Vec<(&str, &str)> = settings
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()))
            .collect();
        paper_spec(&settings)
    }

    /// Builds the linear plant of a case.
    pub fn plant(&self, case: PaperCase) -> Result<Plant, ReproduceError> {
        let mut system = self.system.clone();
        for load in &mut system.loads {
            load.resistance_ohm = case.resistance_ohm;
        }
        for drive in &mut system.drives {
            drive.frequency_hz = case.frequency_hz;
            drive.amplitude_n = case.amplitude_n;
        }
        Ok(Plant::new(system)?)
    }

    /// Builds the kernel of a case.
    pub fn kernel(&self, case: PaperCase) -> Result<Kernel, ReproduceError> {
        Ok(Kernel::new(self.plant(case)?)?.with_control(&self.control))
    }

    /// Returns the plan of the paper: 20 s, the last 10 s averaged.
    pub fn plan(&self) -> RunPlan {
        RunPlan::of(&self.spec.run, 0.0)
    }

    /// Executes the paper's run of one case from rest.
    pub fn run(&self, case: PaperCase) -> Result<RunResult, ReproduceError> {
        let kernel = self.kernel(case)?;
        Ok(simulate(
            &kernel,
            &StartState::rest(&kernel.plant),
            &self.plan(),
        )?)
    }
}

impl PaperCase {
    /// Returns the mean power per force squared, W/N^2.
    pub fn normalised(&self, power_w: f64) -> f64 {
        power_w / (self.amplitude_n * self.amplitude_n)
    }
}
