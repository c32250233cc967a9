//! The paper's harvester, its variants, and its cases of drive and load.

use super::ReproduceError;
use crate::integrate::{Control, Kernel};
use crate::plant::{Plant, System};
use crate::run::{RunPlan, RunResult, StartState, simulate};
use crate::spec::{Spec, SpecFile};
use crate::structure::modes;

const PAPER: &str = include_str!("../../../../examples/impact-harvester-2019/harvester.toml");

/// The spec of the paper's harvester with some keys set.
///
/// # Errors
/// A key or value that the spec does not allow.
pub fn paper_spec(settings: &[(&str, &str)]) -> Result<Spec, ReproduceError> {
    Ok(paper_file(settings)?.spec()?)
}

/// The file of the paper's harvester with some keys set.
///
/// # Errors
/// A key that there is not.
pub fn paper_file(settings: &[(&str, &str)]) -> Result<SpecFile, ReproduceError> {
    let mut file = SpecFile::from_text(PAPER);
    for (key, value) in settings {
        file.set(key, value)?;
    }
    Ok(file)
}

/// A harvester with its modes: cases of drive and load are made from it without solving the structure again.
pub(super) struct PaperHarvester {
    pub spec: Spec,
    pub system: System,
    /// Ends its marches early, and counts the runs of the figures.
    pub control: Control,
}

/// A drive and a load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PaperCase {
    pub frequency_hz: f64,
    pub amplitude_n: f64,
    pub resistance_ohm: f64,
}

/// The load of figures 6 and 7.
pub(super) const MEGOHM: f64 = 1e6;

/// The case of figure 7; figure 8 varies its load.
pub(super) const ABOVE_RESONANCE: PaperCase = PaperCase {
    frequency_hz: 13.0,
    amplitude_n: 200.0,
    resistance_ohm: MEGOHM,
};

/// The case of figure 9, at the load of figure 7.
pub(super) const BELOW_RESONANCE: PaperCase = PaperCase {
    frequency_hz: 6.0,
    amplitude_n: 50.0,
    resistance_ohm: MEGOHM,
};

impl PaperHarvester {
    /// The paper's harvester with some keys set, its marches under a control.
    pub fn with(settings: &[(String, String)], control: &Control) -> Result<Self, ReproduceError> {
        let spec = Self::spec(settings)?;
        let system = System::assemble(&spec, modes(&spec)?)?;
        Ok(Self {
            spec,
            system,
            control: control.clone(),
        })
    }

    /// Its spec alone.
    pub fn spec(settings: &[(String, String)]) -> Result<Spec, ReproduceError> {
        let settings: Vec<(&str, &str)> = settings
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()))
            .collect();
        paper_spec(&settings)
    }

    /// The linear plant of a case.
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

    /// A case ready to be marched.
    pub fn kernel(&self, case: PaperCase) -> Result<Kernel, ReproduceError> {
        Ok(Kernel::new(self.plant(case)?)?.with_control(&self.control))
    }

    /// The paper's run: 20 s, the last 10 s averaged.
    pub fn plan(&self) -> RunPlan {
        RunPlan::of(&self.spec.run, 0.0)
    }

    /// The paper's run of one case from rest.
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
    /// Mean power per force squared, W/N^2.
    pub fn normalised(&self, power_w: f64) -> f64 {
        power_w / (self.amplitude_n * self.amplitude_n)
    }
}
