//! `jounce rig SPEC --to FILE`

use super::modes::held;
use crate::failure::Failure;
use crate::measured_file::positive;
use crate::output::{line, print};
use crate::spec_arguments::{SpecArguments, frequency_hz};
use clap::Args;
use jounce::linear::Response;
use jounce::plant::{Plant, System};
use jounce::run::{RunPlan, simulate};
use jounce::spec::{Gravity, Quantity as Unit, Spec};
use jounce::structure;
use jounce::study::Prepared;
use jounce_measure::recording::Recording;
use jounce_measure::rig::{HammerTest, Sensor, hammer_test, shaken};
use jounce_measure::write::write;
use std::path::PathBuf;

/// Arguments of `rig`.
#[derive(Debug, Args)]
pub struct Rig {
    #[command(flatten)]
    spec: SpecArguments,
    /// The recording to write: .uff, .parquet or .csv.
    #[arg(long, value_name = "FILE")]
    to: PathBuf,
    /// Samples per second.
    #[arg(long, default_value = "2048Hz")]
    rate: String,
    /// White noise of every sensor, rms over that of its signal.
    #[arg(long, default_value_t = 0.0)]
    noise: f64,
    /// Bits of the converters; without, nothing is rounded.
    #[arg(long)]
    bits: Option<u32>,
    /// Seed of hits and noise.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Strikes this point with a hammer, stops and drives taken away, instead of marching the run.
    #[arg(long, value_name = "POINT")]
    hammer: Option<String>,
    /// Point with an accelerometer in a hammer test; can be given several times; by default every point and patch records.
    #[arg(long, value_name = "POINT", requires = "hammer")]
    at: Vec<String>,
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
    /// Holds a body still in a hammer test; can be given several times.
    #[arg(long, value_name = "BODY", requires = "hammer")]
    hold: Vec<String>,
    /// Holds every mass still in a hammer test.
    #[arg(long, requires = "hammer")]
    fixed_table: bool,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl Rig {
    /// Simulates the test and writes what its sensors record.
    pub fn run(&self) -> Result<(), Failure> {
        let spec = self.spec.spec()?;
        let rate_hz = frequency_hz("rate", &self.rate)?;
        let sensor = Sensor { noise_ratio: self.noise, bits: self.bits };
        let recording = match &self.hammer {
            Some(point) => self.struck(spec, point, rate_hz, sensor)?,
            None => self.shaken(spec, rate_hz, sensor)?,
        };
        write(&recording, &self.to)?;
        let names: Vec<&str> = recording.channels.iter().map(|channel| channel.name.as_str()).collect();
        let (samples, rate_hz) = (recording.grid.len(), recording.rate());
        if self.json {
            print(&serde_json::json!({ "file": self.to, "samples": samples, "rate_hz": rate_hz, "channels": names, "seed": self.seed }));
        } else {
            line(format!("{}: {samples} samples at {rate_hz} Hz of {} (simulated)", self.to.display(), names.join(", ")));
        }
        Ok(())
    }

    fn struck(&self, mut spec: Spec, point: &str, rate_hz: f64, sensor: Sensor) -> Result<Recording, Failure> {
        let held = held(&self.hold, self.fixed_table, &spec);
        spec.drive.clear();
        spec.stop.clear();
        spec.gravity = Gravity::default();
        let modes = structure::modes_holding(&spec, &held)?;
        let points: Vec<String> = if self.at.is_empty() { modes.shape.keys().cloned().collect() } else { self.at.clone() };
        let patches = modes.patch.keys().filter(|_| self.at.is_empty()).map(|patch| Response::Voltage(patch.clone()));
        let responses = points.into_iter().map(Response::Acceleration).chain(patches).collect();
        let test = HammerTest {
            point: point.to_owned(),
            responses,
            hits: self.hits,
            block_s: positive("--block", &self.block, Unit::Time)?,
            peak_force_n: positive("--peak", &self.peak, Unit::Force)?,
            contact_time_s: positive("--contact", &self.contact, Unit::Time)?,
            rate_hz,
            sensor,
            seed: self.seed,
        };
        Ok(hammer_test(&Plant::new(System::assemble(&spec, modes)?)?, &test)?)
    }

    fn shaken(&self, spec: Spec, rate_hz: f64, sensor: Sensor) -> Result<Recording, Failure> {
        let prepared = Prepared::new(spec)?;
        let start = prepared.start(&self.spec.folder())?;
        let kernel = prepared.from_state(&start)?;
        let run = &prepared.spec.run;
        let plan = RunPlan::of(run, run.average_over_s);
        let answer = simulate(&kernel, &start, &plan).map_err(jounce::study::StudyError::from)?;
        let between_s = (plan.duration_s - plan.average_over_s, plan.duration_s);
        Ok(shaken(&kernel, &answer.trajectory, between_s, rate_hz, sensor, self.seed)?)
    }
}
