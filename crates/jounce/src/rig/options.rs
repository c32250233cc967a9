//! Options of a virtual test.

use crate::error::Error;
use crate::options::{
    check_above_zero, defaults, frequency_hz, refuse_changed, resistance_ohm, si, time_s,
};
use crate::recording::Recording;
use jounce_experiment::rig::{Cable, RigError, Sensor, add_accelerometers};
use jounce_spec::{Quantity, Spec};
use serde::{Deserialize, Serialize};

/// Options that apply to a hammer test.
const OF_HAMMER: [&str; 4] = ["hits", "block_s", "peak_n", "contact_s"];
/// Options that apply to a shaker test.
const OF_SHAKER: [&str; 6] = [
    "solution",
    "wander_time_s",
    "amplitude_wander",
    "frequency_wander",
    "amplitude_drift",
    "frequency_drift",
];
/// Options that apply to solutions as starts.
const OF_SOLUTION: [&str; 2] = ["starts", "starts_seed"];
/// Options that apply to a recorded base motion.
const OF_BASE: [&str; 2] = ["base_channel", "keep_mean"];
/// Options that change the model and with it its solutions.
const OF_FIXED: [&str; 2] = ["hold", "fixed_table"];

/// Options of [`crate::Harvester::rig`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RigOptions {
    /// Sampling rate.
    #[arg(long = "rate", value_name = "FREQUENCY", value_parser = frequency_hz, default_value = "2048 Hz")]
    pub rate_hz: f64,
    /// White noise of every sensor: its rms divided by the rms of the signal.
    #[arg(long, default_value_t = 0.0)]
    pub noise: f64,
    /// Bits of the converters; without it nothing is rounded.
    #[arg(long)]
    pub bits: Option<u32>,
    /// Seed of hits, fluctuation and noise.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Point with an accelerometer; can be given several times; by default every point and patch is
    /// recorded in a hammer test, and no point in other tests.
    #[arg(long, value_name = "POINT")]
    pub at: Vec<String>,
    /// Mass of each accelerometer of --at, as in 2g, which loads the structure.
    #[arg(long = "sensor-mass", value_name = "MASS", value_parser = si(Quantity::Mass))]
    pub sensor_mass_kg: Option<f64>,
    /// Capacitance of the cable of each patch with its amplifier, as in 1nF, which lowers the
    /// voltage.
    #[arg(long = "cable", value_name = "CAPACITANCE", value_parser = si(Quantity::Capacitance))]
    pub cable_f: Option<f64>,
    /// Resistance of the cable of each patch with its amplifier, as in 10Mohm.
    #[arg(long = "cable-leakage", value_name = "RESISTANCE", value_parser = resistance_ohm)]
    pub cable_leakage_ohm: Option<f64>,
    /// Fixes a body; can be given several times.
    #[arg(long, value_name = "BODY")]
    pub hold: Vec<String>,
    /// Fixes every mass.
    #[arg(long)]
    pub fixed_table: bool,
    /// Hits this point with a hammer, with stops and drives removed, instead of the run of the
    /// spec.
    #[arg(long, value_name = "POINT")]
    pub hammer: Option<String>,
    /// Number of hits.
    #[arg(long, default_value_t = 5)]
    pub hits: usize,
    /// Time between two hits.
    #[arg(long = "block", value_name = "TIME", value_parser = time_s, default_value = "4 s")]
    pub block_s: f64,
    /// Largest force; each hit differs from it by up to 20 %.
    #[arg(long = "peak", value_name = "FORCE", value_parser = si(Quantity::Force), default_value = "20 N")]
    pub peak_n: f64,
    /// Contact time; each hit differs from it by up to 10 %.
    #[arg(long = "contact", value_name = "TIME", value_parser = time_s, default_value = "3 ms")]
    pub contact_s: f64,
    /// Starts on a solution of the model, by its id in `basins`, as in 1a, and changes to another
    /// one at a time of the record, as in 3a@42s; can be given several times. By default the run of
    /// the spec.
    #[arg(long, value_name = "ID[@TIME]")]
    pub solution: Vec<String>,
    /// Number of random starts that find those solutions, as `basins --starts`.
    #[arg(long, default_value_t = 40)]
    pub starts: usize,
    /// Seed of those starts, as `basins --seed`.
    #[arg(long, default_value_t = 1)]
    pub starts_seed: u64,
    /// Relative standard deviation of the drive amplitude.
    #[arg(long, value_name = "RATIO", default_value_t = 0.0)]
    pub amplitude_wander: f64,
    /// Relative standard deviation of the drive frequency.
    #[arg(long, value_name = "RATIO", default_value_t = 0.0)]
    pub frequency_wander: f64,
    /// Correlation time of both fluctuations.
    #[arg(long = "wander-time", value_name = "TIME", value_parser = time_s, default_value = "5 s")]
    pub wander_time_s: f64,
    /// Relative change of the drive amplitude from begin to end.
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        allow_hyphen_values = true
    )]
    pub amplitude_drift: f64,
    /// Relative change of the drive frequency from begin to end.
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        allow_hyphen_values = true
    )]
    pub frequency_drift: f64,
    /// Recording whose acceleration moves the base, for its duration, instead of the drives.
    #[arg(skip)]
    #[serde(skip)]
    pub base: Option<Recording>,
    /// Channel of the recording of the base; by default the first acceleration.
    #[arg(long, value_name = "CHANNEL")]
    pub base_channel: Option<String>,
    /// Retains the mean of that channel; by default it is subtracted as gravity and offset.
    #[arg(long)]
    pub keep_mean: bool,
}

impl Default for RigOptions {
    fn default() -> Self {
        defaults()
    }
}

impl RigOptions {
    /// Checks the quantities, and that every option applies to the test.
    pub(super) fn check(&self) -> Result<(), Error> {
        self.check_quantities()?;
        for (applies, fields, expected) in self.conditions() {
            if !applies {
                refuse_changed(self, fields, expected)?;
            }
        }
        match &self.base {
            Some(base) if self.hammer.is_some() || !self.solution.is_empty() => {
                let expected = "it replaces the drives: omit it, or omit `hammer` and `solution`";
                Err(Error::option("base", base.name(), expected))
            }
            _ => Ok(()),
        }
    }

    /// Checks that every quantity is above 0.
    fn check_quantities(&self) -> Result<(), Error> {
        let quantities = [
            ("rate", Some(self.rate_hz), "Hz"),
            ("sensor_mass", self.sensor_mass_kg, "kg"),
            ("cable", self.cable_f, "F"),
            ("cable_leakage", self.cable_leakage_ohm, "ohm"),
            ("block", Some(self.block_s), "s"),
            ("peak", Some(self.peak_n), "N"),
            ("contact", Some(self.contact_s), "s"),
            ("wander_time", Some(self.wander_time_s), "s"),
        ];
        for (option, value, unit) in quantities {
            if let Some(value) = value {
                check_above_zero(option, value, unit)?;
            }
        }
        Ok(())
    }

    /// Returns the conditions of options: true where the options apply, their fields, and what they
    /// need.
    fn conditions(&self) -> [(bool, &'static [&'static str], &'static str); 7] {
        let is_unsteady = self.amplitude_wander != 0.0 || self.frequency_wander != 0.0;
        [
            (
                !self.at.is_empty(),
                &["sensor_mass_kg"],
                "it needs accelerometers: name their points with `at`",
            ),
            (
                self.hammer.is_some(),
                &OF_HAMMER,
                "it applies to a hammer test: name the point with `hammer`, or omit it",
            ),
            (
                self.hammer.is_none(),
                &OF_SHAKER,
                "it applies to a shaker test: omit it, or omit `hammer`",
            ),
            (
                is_unsteady,
                &["wander_time_s"],
                "it is the correlation time of a fluctuation: give `amplitude_wander` or `frequency_wander` too, or omit it",
            ),
            (
                !self.solution.is_empty(),
                &OF_SOLUTION,
                "it applies to solutions as starts: name them with `solution`, or omit it",
            ),
            (
                self.solution.is_empty(),
                &OF_FIXED,
                "a solution is one of the complete model: omit it, or omit `solution`",
            ),
            (
                self.base.is_some(),
                &OF_BASE,
                "it applies to a recorded base motion: give the recording as `base`, or omit it",
            ),
        ]
    }

    /// Returns the sensors.
    pub(super) fn sensor(&self) -> Sensor {
        Sensor {
            noise_ratio: self.noise,
            bits: self.bits,
        }
    }

    /// Adds cables and accelerometers to a spec.
    pub(super) fn add_instruments(&self, spec: &mut Spec) -> Result<(), RigError> {
        if self.cable_f.is_some() || self.cable_leakage_ohm.is_some() {
            Cable {
                capacitance_f: self.cable_f.unwrap_or(0.0),
                leakage_ohm: self.cable_leakage_ohm,
            }
            .wire(spec)?;
        }
        match self.sensor_mass_kg {
            Some(mass_kg) => add_accelerometers(spec, &self.at, mass_kg),
            None => Ok(()),
        }
    }
}
