//! Simulated shaker test.

use super::SensingArguments;
use crate::failure::Failure;
use crate::measured_file::{load_channels, parse_positive, summary};
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
    pub fn record(
        &self,
        mut spec: Spec,
        held_bodies: &[String],
        sensing: &SensingArguments,
        folder: &Path,
    ) -> Result<Recording, Failure> {
        if let Some(file) = &self.base {
            self.move_base(&mut spec, file)?;
        }
        let (duration_s, average_over_s) = (spec.run.duration_s, spec.run.average_over_s);
        let modes = structure::modes_holding(&spec, held_bodies)?;
        let starts = match &self.solution[..] {
            [] => vec![(0.0, start_of_run(&spec, &modes, folder)?)],
            requested => self.solutions(&spec, requested)?,
        };
        let disturbance = Disturbance {
            amplitude_ratio: self.amplitude_wander,
            frequency_ratio: self.frequency_wander,
            memory_s: parse_positive("--wander-time", &self.wander_time, Unit::Time)?,
            amplitude_drift: self.amplitude_drift,
            frequency_drift: self.frequency_drift,
        };
        let is_zero = Disturbance {
            memory_s: disturbance.memory_s,
            ..Disturbance::NONE
        } == disturbance;
        let test = ShakerTest {
            rate_hz: sensing.rate_hz()?,
            duration_s: average_over_s,
            before_s: if self.solution.is_empty() {
                duration_s - average_over_s
            } else {
                0.0
            },
            starts,
            disturbance: if is_zero {
                Disturbance::NONE
            } else {
                disturbance
            },
            accelerometers: sensing.at.clone(),
            sensor: sensing.sensor(),
            seed: sensing.seed,
        };
        Ok(shaker_test(&spec, &modes, &test, &Control::default())?)
    }

    fn move_base(&self, spec: &mut Spec, file: &Path) -> Result<(), Failure> {
        let mut recording_summary = summary(file)?;
        let heads = recording_summary.heads();
        let found = driving_channel(
            (&recording_summary.name, &heads, &recording_summary.findings),
            self.base_channel.as_deref(),
            Quantity::Acceleration,
        );
        let number = found.map_err(|error| Failure::usage(format!("--base-channel: {error}")))?;
        let assumed = heads[number].assumed_unit_issue(Quantity::Acceleration);
        recording_summary.findings.extend(assumed);
        let base_recording = load_channels(recording_summary, &[number])?;
        let name = &base_recording.channels[0].name;
        let mean = on_recorded_base(spec, &base_recording, name, self.keep_mean)?;
        let mean_treatment = if self.keep_mean {
            "retained"
        } else {
            "subtracted"
        };
        eprintln!(
            "the base moves as {name} of {}; its mean of {mean:.5} m/s^2 is {mean_treatment}",
            base_recording.name
        );
        Ok(())
    }

    /// Returns times and states of the requested solutions.
    fn solutions(
        &self,
        spec: &Spec,
        requested: &[String],
    ) -> Result<Vec<(f64, StartState)>, Failure> {
        let known_solutions = solutions(
            spec,
            &SolutionSearch {
                starts: self.starts,
                seed: self.starts_seed,
                ..SolutionSearch::default()
            },
            &Control::default(),
        )?;
        let start = |(number, text): (usize, &String)| {
            let (id, time) = text
                .split_once('@')
                .map_or((text.as_str(), None), |(id, time)| (id, Some(time)));
            let at_s = match time {
                Some(time) => parse_positive("--solution", time, Unit::Time)?,
                None if number == 0 => 0.0,
                None => {
                    return Err(Failure::usage(format!(
                        "--solution {text}: add the time at which it begins, as in {id}@42s"
                    )));
                }
            };
            let at_s = if number == 0 { 0.0 } else { at_s };
            let start = start_of(&known_solutions, id)
                .map_err(|error| Failure::usage(format!("--solution {text}: {error}")))?;
            Ok((at_s, start))
        };
        requested.iter().enumerate().map(start).collect()
    }
}
