//! Simulated shaker test.

use super::SensingArguments;
use crate::failure::Failure;
use crate::measured_file::{loaded, positive, summary};
use clap::Args;
use jounce_core::integrate::Control;
use jounce_core::run::StartState;
use jounce_core::spec::{Quantity as Unit, Spec, driving_channel};
use jounce_core::structure;
use jounce_measure::recording::{Quantity, Recording};
use jounce_measure::rig::{Disturbance, ShakerTest, on_recorded_base, shaker_test, start_of_run};
use jounce_measure::solution::{SolutionSearch, solutions, start_of};
use std::path::{Path, PathBuf};

/// Options of the simulated shaker.
#[derive(Debug, Args)]
pub struct ShakerArguments {
    /// Starts on a solution of the model, by its id in `basins`, as in 1a, and changes to another
    /// one at a time of the record, as in 3a@42s; can be given several times. By default the run of
    /// the spec.
    #[arg(long, value_name = "ID[@TIME]", conflicts_with_all = ["hammer", "hold", "fixed_table", "base"])]
    solution: Vec<String>,
    /// Number of random starts that find those solutions, as `basins --starts`.
    #[arg(long, default_value_t = 40, requires = "solution")]
    starts: usize,
    /// Seed of those starts, as `basins --seed`.
    #[arg(long, default_value_t = 1, requires = "solution")]
    starts_seed: u64,
    /// Relative standard deviation of the drive amplitude.
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        conflicts_with = "hammer"
    )]
    amplitude_wander: f64,
    /// Relative standard deviation of the drive frequency.
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        conflicts_with = "hammer"
    )]
    frequency_wander: f64,
    /// Correlation time of both fluctuations.
    #[arg(long, value_name = "TIME", default_value = "5s")]
    wander_time: String,
    /// Relative change of the drive amplitude from begin to end.
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        allow_hyphen_values = true,
        conflicts_with = "hammer"
    )]
    amplitude_drift: f64,
    /// Relative change of the drive frequency from begin to end.
    #[arg(
        long,
        value_name = "RATIO",
        default_value_t = 0.0,
        allow_hyphen_values = true,
        conflicts_with = "hammer"
    )]
    frequency_drift: f64,
    /// Moves the base as in this recording, for its duration, instead of the drives of the spec.
    #[arg(long, value_name = "FILE", conflicts_with = "hammer")]
    base: Option<PathBuf>,
    /// Channel of that recording; by default the first acceleration.
    #[arg(long, value_name = "CHANNEL", requires = "base")]
    base_channel: Option<String>,
    /// Retains the mean of that channel; by default it is subtracted as gravity and offset.
    #[arg(long, requires = "base")]
    keep_mean: bool,
}

impl ShakerArguments {
    /// Returns the recording of the test.
    pub fn shaken(
        &self,
        mut spec: Spec,
        held: &[String],
        sensing: &SensingArguments,
        folder: &Path,
    ) -> Result<Recording, Failure> {
        if let Some(file) = &self.base {
            self.move_base(&mut spec, file)?;
        }
        let (duration_s, average_over_s) = (spec.run.duration_s, spec.run.average_over_s);
        let modes = structure::modes_holding(&spec, held)?;
        let starts = match &self.solution[..] {
            [] => vec![(0.0, start_of_run(&spec, &modes, folder)?)],
            wanted => self.solutions(&spec, wanted)?,
        };
        let wander = Disturbance {
            amplitude_ratio: self.amplitude_wander,
            frequency_ratio: self.frequency_wander,
            memory_s: positive("--wander-time", &self.wander_time, Unit::Time)?,
            amplitude_drift: self.amplitude_drift,
            frequency_drift: self.frequency_drift,
        };
        let still = Disturbance {
            memory_s: wander.memory_s,
            ..Disturbance::NONE
        } == wander;
        let test = ShakerTest {
            rate_hz: sensing.rate_hz()?,
            duration_s: average_over_s,
            before_s: if self.solution.is_empty() {
                duration_s - average_over_s
            } else {
                0.0
            },
            starts,
            disturbance: if still { Disturbance::NONE } else { wander },
            accelerometers: sensing.at.clone(),
            sensor: sensing.sensor(),
            seed: sensing.seed,
        };
        Ok(shaker_test(&spec, &modes, &test, &Control::default())?)
    }

    fn move_base(&self, spec: &mut Spec, file: &Path) -> Result<(), Failure> {
        let mut survey = summary(file)?;
        let heads = survey.heads();
        let found = driving_channel(
            (&survey.name, &heads, &survey.findings),
            self.base_channel.as_deref(),
            Quantity::Acceleration,
        );
        let number = found.map_err(|error| Failure::usage(format!("--base-channel: {error}")))?;
        let assumed = heads[number].assumed_unit_issue(Quantity::Acceleration);
        survey.findings.extend(assumed);
        let recording = loaded(survey, &[number])?;
        let name = &recording.channels[0].name;
        let mean = on_recorded_base(spec, &recording, name, self.keep_mean)?;
        let words = if self.keep_mean {
            "retained"
        } else {
            "subtracted"
        };
        eprintln!(
            "the base moves as {name} of {}; its mean of {mean:.5} m/s^2 is {words}",
            recording.name
        );
        Ok(())
    }

    /// Returns times and states of the requested solutions.
    fn solutions(&self, spec: &Spec, wanted: &[String]) -> Result<Vec<(f64, StartState)>, Failure> {
        let found = solutions(
            spec,
            &SolutionSearch {
                starts: self.starts,
                seed: self.starts_seed,
                ..SolutionSearch::default()
            },
            &Control::default(),
        )?;
        let one = |(number, text): (usize, &String)| {
            let (id, at) = text
                .split_once('@')
                .map_or((text.as_str(), None), |(id, at)| (id, Some(at)));
            let at_s = match at {
                Some(at) => positive("--solution", at, Unit::Time)?,
                None if number == 0 => 0.0,
                None => {
                    return Err(Failure::usage(format!(
                        "--solution {text}: add the time at which it begins, as in {id}@42s"
                    )));
                }
            };
            let at_s = if number == 0 { 0.0 } else { at_s };
            let start = start_of(&found, id)
                .map_err(|error| Failure::usage(format!("--solution {text}: {error}")))?;
            Ok((at_s, start))
        };
        wanted.iter().enumerate().map(one).collect()
    }
}
