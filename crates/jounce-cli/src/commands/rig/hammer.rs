//! Simulated hammer test.

use super::SensingArguments;
use crate::failure::Failure;
use crate::measured_file::parse_positive;
use clap::Args;
use jounce_core::linear::FrfResponse;
use jounce_core::plant::{Plant, System};
use jounce_core::spec::{Gravity, Quantity as Unit, Spec};
use jounce_core::structure;
use jounce_measure::recording::Recording;
use jounce_measure::rig::{HammerTest, hammer_test};

/// Options of the simulated hammer.
#[derive(Debug, Args)]
pub struct HammerTestArguments {
    /// Hits this point with a hammer, with stops and drives removed, instead of the run of the
    /// spec.
    #[arg(long, value_name = "POINT")]
    hammer: Option<String>,
    /// Number of hits.
    #[arg(long, default_value_t = 5, requires = "hammer")]
    hits: usize,
    /// Time between two hits.
    #[arg(long, default_value = "4s", value_name = "TIME", requires = "hammer")]
    block: String,
    /// Largest force; each hit differs from it by up to 20 %.
    #[arg(long, default_value = "20N", value_name = "FORCE", requires = "hammer")]
    peak: String,
    /// Contact time; each hit differs from it by up to 10 %.
    #[arg(long, default_value = "3ms", value_name = "TIME", requires = "hammer")]
    contact: String,
}

impl HammerTestArguments {
    /// Returns the excitation point.
    pub fn point(&self) -> Option<&str> {
        self.hammer.as_deref()
    }

    /// Returns the recording of the test.
    pub fn record(
        &self,
        mut spec: Spec,
        point: &str,
        held_bodies: &[String],
        sensing: &SensingArguments,
    ) -> Result<Recording, Failure> {
        spec.take_drives_away();
        spec.stop.clear();
        spec.gravity = Gravity::default();
        let modes = structure::modes_holding(&spec, held_bodies)?;
        let points: Vec<String> = if sensing.at.is_empty() {
            modes.shape.keys().cloned().collect()
        } else {
            sensing.at.clone()
        };
        let patches = modes
            .patch
            .keys()
            .filter(|_| sensing.at.is_empty())
            .map(|patch| FrfResponse::Voltage(patch.clone()));
        let responses = points
            .into_iter()
            .map(FrfResponse::Acceleration)
            .chain(patches)
            .collect();
        let test = HammerTest {
            point: point.to_owned(),
            responses,
            hits: self.hits,
            block_s: parse_positive("--block", &self.block, Unit::Time)?,
            peak_force_n: parse_positive("--peak", &self.peak, Unit::Force)?,
            contact_time_s: parse_positive("--contact", &self.contact, Unit::Time)?,
            rate_hz: sensing.rate_hz()?,
            sensor: sensing.sensor(),
            seed: sensing.seed,
        };
        let plant = Plant::new(System::assemble(&spec, modes)?)?;
        Ok(hammer_test(&plant, &test)?)
    }
}
