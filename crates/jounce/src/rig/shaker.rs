//! Simulated shaker test.

use super::{BaseMotion, RigOptions, RigResult};
use crate::error::Error;
use crate::harvester::Harvester;
use crate::recording::Recording;
use jounce_analysis::run::StartState;
use jounce_control::Control;
use jounce_data::recording::{self as data, Issue, Quantity};
use jounce_experiment::rig::{
    Disturbance, RigError, ShakerTest, on_recorded_base, shaker_test, start_of_run,
};
use jounce_experiment::solution::{SolutionError, SolutionSearch, solutions, start_of};
use jounce_model::structure::modes_holding;
use jounce_spec::{Quantity as Unit, Spec, driving_channel};

/// Records the averaging window of the run, solutions of the model, or a recorded base motion.
pub(super) fn record(
    harvester: &Harvester,
    mut spec: Spec,
    fixed: &[String],
    options: &RigOptions,
) -> Result<RigResult, Error> {
    let base = (options.base.as_ref())
        .map(|base| move_base(&mut spec, base, options))
        .transpose()?;
    let (duration_s, average_over_s) = (spec.run.duration_s, spec.run.average_over_s);
    let modes = modes_holding(&spec, fixed)?;
    let (starts, before_s) = match options.solution.is_empty() {
        true => (
            vec![(0.0, start_of_run(&spec, &modes, harvester.folder())?)],
            duration_s - average_over_s,
        ),
        false => (options.starts_on(&spec, harvester.control())?, 0.0),
    };
    let test = ShakerTest {
        rate_hz: options.rate_hz,
        duration_s: average_over_s,
        before_s,
        starts,
        disturbance: options.disturbance(),
        accelerometers: options.at.clone(),
        sensor: options.sensor(),
        seed: options.seed,
    };
    let recording = shaker_test(&spec, &modes, &test, harvester.control())?;
    Ok(RigResult::new(recording.into(), base, options.seed))
}

/// Moves the base as in a recording.
fn move_base(
    spec: &mut Spec,
    recording: &Recording,
    options: &RigOptions,
) -> Result<BaseMotion, Error> {
    let recording = recording.data();
    let heads = recording.heads();
    let number = driving_channel(
        (&recording.name, &heads, &recording.issues),
        options.base_channel.as_deref(),
        Quantity::Acceleration,
    );
    let number = number.map_err(RigError::from)?;
    let channel = recording.channels[number].clone();
    let is_of_other = |name: &String| {
        *name != channel.name && recording.channels.iter().any(|other| other.name == *name)
    };
    let belongs = |issue: &&Issue| !issue.channel.as_ref().is_some_and(is_of_other);
    let assumed = heads[number].assumed_unit_issue(Quantity::Acceleration);
    let issues = recording.issues.iter().filter(belongs).cloned();
    let base = data::Recording {
        name: recording.name.clone(),
        over: recording.over,
        grid: recording.grid.clone(),
        issues: issues.chain(assumed).collect(),
        channels: vec![channel],
    };
    let base = base.into_even()?;
    let name = &base.channels[0].name;
    Ok(BaseMotion {
        mean_m_s2: on_recorded_base(spec, &base, name, options.keep_mean)?,
        channel: name.clone(),
        is_mean_kept: options.keep_mean,
        recording: base.name,
        issues: base.issues,
    })
}

impl RigOptions {
    fn disturbance(&self) -> Disturbance {
        let disturbance = Disturbance {
            amplitude_ratio: self.amplitude_wander,
            frequency_ratio: self.frequency_wander,
            memory_s: self.wander_time_s,
            amplitude_drift: self.amplitude_drift,
            frequency_drift: self.frequency_drift,
        };
        // The correlation time of no fluctuation has no effect.
        let without = Disturbance {
            memory_s: disturbance.memory_s,
            ..Disturbance::NONE
        };
        match disturbance == without {
            true => Disturbance::NONE,
            false => disturbance,
        }
    }

    /// Returns the states on the solutions, each with the time of the record at which it begins, s.
    fn starts_on(&self, spec: &Spec, control: &Control) -> Result<Vec<(f64, StartState)>, Error> {
        let requested = (self.solution.iter().enumerate())
            .map(|(number, text)| id_and_time(number, text))
            .collect::<Result<Vec<_>, _>>()?;
        let search = SolutionSearch {
            starts: self.starts,
            seed: self.starts_seed,
            ..SolutionSearch::default()
        };
        let known = solutions(spec, &search, control)?;
        // A stopped search is incomplete.
        if control.is_stopped() {
            return Err(Error::Stopped);
        }
        let start = |(id, at_s)| match start_of(&known, id) {
            Ok(start) => Ok((at_s, start)),
            Err(SolutionError::UnknownSolution { known, .. }) => {
                let expected = format!("the model's solutions are {known}");
                Err(Error::option("solution", id, expected))
            }
            Err(error) => Err(error.into()),
        };
        requested.into_iter().map(start).collect()
    }
}

/// Reads `ID` or `ID@TIME`; the first one begins with the record.
fn id_and_time(number: usize, text: &str) -> Result<(&str, f64), Error> {
    let (id, time) = match text.split_once('@') {
        Some((id, time)) => (id, Some(time)),
        None => (text, None),
    };
    let at_s = match time.map(|time| Unit::Time.read(time)) {
        Some(Ok(at_s)) if at_s > 0.0 && at_s.is_finite() => at_s,
        Some(Ok(_)) => {
            let expected = "its time must be greater than 0 s";
            return Err(Error::option("solution", text, expected));
        }
        Some(Err(error)) => return Err(Error::option("solution", text, error.to_string())),
        None if number == 0 => 0.0,
        None => {
            let expected = format!("add the time at which it begins, as in {id}@42s");
            return Err(Error::option("solution", text, expected));
        }
    };
    Ok((id, if number == 0 { 0.0 } else { at_s }))
}
