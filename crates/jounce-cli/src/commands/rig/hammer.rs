//! A hammer test of the rig.

use super::SensingArguments;
use crate::failure::Failure;
use crate::measured_file::positive;
use clap::Args;
use jounce::linear::FrfResponse;
use jounce::plant::{Plant, System};
use jounce::spec::{Gravity, Quantity as Unit, Spec};
use jounce::structure;
use jounce_measure::recording::Recording;
use jounce_measure::rig::{HammerTest, hammer_test};

/// How a hammer strikes.
#[derive(Debug, Args)]
pub struct HammerTestArguments {
    /// Strikes this point with a hammer, stops and drives taken away, instead of marching the run.
    #[arg(long, value_name = "POINT")]
    hammer: Option<String>,
    /// Number of hits.
    #[arg(long, default_value_t = 5, requires = "hammer")]
    hits: usize,
    /// Time from hit to hit.
    #[arg(long, default_value = "4s", value_name = "TIME", requires = "hammer")]
    block: String,
    /// Largest force; each hit differs from it by up to 20 %.
    #[arg(long, default_value = "20N", value_name = "FORCE", requires = "hammer")]
    peak: String,
    /// Time in contact; each hit differs from it by up to 10 %.
    #[arg(long, default_value = "3ms", value_name = "TIME", requires = "hammer")]
    contact: String,
}

impl HammerTestArguments {
    /// The point that is struck.
    pub fn point(&self) -> Option<&str> {
        self.hammer.as_deref()
    }

    /// The recording of the test.
    pub fn struck(
        &self,
        mut spec: Spec,
        point: &str,
        held: &[String],
        sensing: &SensingArguments,
    ) -> Result<Recording, Failure> {
        spec.take_drives_away();
        spec.stop.clear();
        spec.gravity = Gravity::default();
        let modes = structure::modes_holding(&spec, held)?;
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
            block_s: positive("--block", &self.block, Unit::Time)?,
            peak_force_n: positive("--peak", &self.peak, Unit::Force)?,
            contact_time_s: positive("--contact", &self.contact, Unit::Time)?,
            rate_hz: sensing.rate_hz()?,
            sensor: sensing.sensor(),
            seed: sensing.seed,
        };
        let plant = Plant::new(System::assemble(&spec, modes)?)?;
        Ok(hammer_test(&plant, &test)?)
    }
}
