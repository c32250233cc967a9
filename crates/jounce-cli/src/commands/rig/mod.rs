//! `jounce rig SPEC --to FILE`

mod hammer;
mod shaker;

use crate::failure::Failure;
use crate::measured_file::parse_positive;
use crate::output::{line, print};
use crate::spec_arguments::{SpecArguments, frequency_hz};
use clap::Args;
use hammer::HammerTestArguments;
use jounce_core::spec::{Quantity as Unit, Spec};
use jounce_measure::rig::{Cable, Sensor, add_accelerometers};
use jounce_measure::write::write;
use shaker::ShakerArguments;
use std::path::PathBuf;

/// Arguments of `rig`.
#[derive(Debug, Args)]
pub struct Rig {
    #[command(flatten)]
    spec: SpecArguments,
    /// The recording to write: .uff, .parquet or .csv.
    #[arg(long, value_name = "FILE")]
    to: PathBuf,
    #[command(flatten)]
    sensing: SensingArguments,
    #[command(flatten)]
    hammer: HammerTestArguments,
    #[command(flatten)]
    shaker: ShakerArguments,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

/// Options of every simulated test.
#[derive(Debug, Args)]
pub struct SensingArguments {
    /// Sampling rate.
    #[arg(long, default_value = "2048Hz")]
    rate: String,
    /// White noise of every sensor: its rms divided by the rms of the signal.
    #[arg(long, default_value_t = 0.0)]
    noise: f64,
    /// Bits of the converters; without it nothing is rounded.
    #[arg(long)]
    bits: Option<u32>,
    /// Seed of hits, fluctuation and noise.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Point with an accelerometer; can be given several times; by default every point and patch is
    /// recorded in a hammer test, and no point in other tests.
    #[arg(long, value_name = "POINT")]
    at: Vec<String>,
    /// Mass of each accelerometer of --at, as in 2g, which loads the structure.
    #[arg(long, value_name = "MASS", requires = "at")]
    sensor_mass: Option<String>,
    /// Capacitance of the cable of each patch with its amplifier, as in 1nF, which lowers the
    /// voltage.
    #[arg(long, value_name = "CAPACITANCE")]
    cable: Option<String>,
    /// Resistance of the cable of each patch with its amplifier, as in 10Mohm.
    #[arg(long, value_name = "RESISTANCE")]
    cable_leakage: Option<String>,
    /// Fixes a body; can be given several times.
    #[arg(long, value_name = "BODY")]
    hold: Vec<String>,
    /// Fixes every mass.
    #[arg(long)]
    fixed_table: bool,
}

impl SensingArguments {
    /// Returns the sampling rate.
    pub fn rate_hz(&self) -> Result<f64, Failure> {
        frequency_hz("rate", &self.rate)
    }

    /// Returns the sensors.
    pub fn sensor(&self) -> Sensor {
        Sensor {
            noise_ratio: self.noise,
            bits: self.bits,
        }
    }

    /// Returns the names of the fixed bodies.
    pub fn held_bodies(&self, spec: &Spec) -> Vec<String> {
        let masses = spec.mass.keys().filter(|_| self.fixed_table);
        self.hold.iter().chain(masses).cloned().collect()
    }

    /// Adds cables and accelerometers to the spec.
    fn fit(&self, spec: &mut Spec) -> Result<(), Failure> {
        if self.cable.is_some() || self.cable_leakage.is_some() {
            let capacitance_f = self.cable.as_ref().map_or(Ok(0.0), |text| {
                parse_positive("--cable", text, Unit::Capacitance)
            })?;
            let leakage_ohm = self
                .cable_leakage
                .as_ref()
                .map(|text| parse_positive("--cable-leakage", text, Unit::Resistance))
                .transpose()?;
            Cable {
                capacitance_f,
                leakage_ohm,
            }
            .wire(spec)?;
        }
        if let Some(text) = &self.sensor_mass {
            add_accelerometers(
                spec,
                &self.at,
                parse_positive("--sensor-mass", text, Unit::Mass)?,
            )?;
        }
        Ok(())
    }
}

impl Rig {
    /// Simulates the test and writes the recording of its sensors.
    pub fn run(&self) -> Result<(), Failure> {
        let mut spec = self.spec.spec()?;
        // Masses of the model are fixed, masses of the instruments are free.
        let held_bodies = self.sensing.held_bodies(&spec);
        self.sensing.fit(&mut spec)?;
        let recording = match self.hammer.point() {
            Some(point) => self
                .hammer
                .record(spec, point, &held_bodies, &self.sensing)?,
            None => self
                .shaker
                .record(spec, &held_bodies, &self.sensing, &self.spec.folder())?,
        };
        write(&recording, &self.to)?;
        let names: Vec<&str> = recording
            .channels
            .iter()
            .map(|channel| channel.name.as_str())
            .collect();
        let (samples, rate_hz, seed) = (recording.grid.len(), recording.rate(), self.sensing.seed);
        recording
            .findings
            .iter()
            .for_each(|finding| eprintln!("{finding}"));
        if self.json {
            print(&serde_json::json!({
                "file": self.to,
                "samples": samples,
                "rate_hz": rate_hz,
                "channels": names,
                "seed": seed,
                "findings": recording.findings,
            }));
        } else {
            line(format!(
                "{}: {samples} samples at {rate_hz} Hz of {} (simulated)",
                self.to.display(),
                names.join(", ")
            ));
        }
        Ok(())
    }
}
