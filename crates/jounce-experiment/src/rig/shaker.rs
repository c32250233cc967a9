//! Shaker test of a model as recorded by its sensors.

use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_control::Control;
use jounce_dynamics::{Kernel, Trajectory};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::Modes;
use jounce_signal::RandomStream;
use jounce_spec::Spec;

use super::disturbance::{DriveCourse, disturbed, drive_courses};
use super::jumps::jumps;
use super::sensed_channel::{SensedChannel, sensors};
use super::{Disturbance, RigError, Sensor};
use crate::solution::{SensorOutput, outputs};
use jounce_data::recording::{Channel, Grid, Issue, IssueKind, Over, Recording};

/// Shaker test.
#[derive(Debug, Clone, PartialEq)]
pub struct ShakerTest {
    /// Samples per second.
    pub rate_hz: f64,
    /// Length of the record, s.
    pub duration_s: f64,
    /// Time integrated before the record begins, s.
    pub before_s: f64,
    /// Initial states with their times in the record (s): the first one, and other coexisting
    /// solutions from which the run continues. The motion jumps at the next cycle start of the
    /// first drive; the cause of the jump is not modelled.
    pub starts: Vec<(f64, StartState)>,
    /// Disturbance of the shaker.
    pub disturbance: Disturbance,
    /// Points with an accelerometer.
    pub accelerometers: Vec<String>,
    /// Sensors.
    pub sensor: Sensor,
    /// Seed of disturbance and noise.
    pub seed: u64,
}

/// Records the test; `control` can cancel the runs. Channels: voltages of all patches, forces of
/// all stops, the base acceleration as `base.acceleration`, and each accelerometer. The base is the
/// first one that moves, by the name of its drive, else the one shaken by the first force. The
/// first sample is at 0 s.
///
/// # Errors
/// A setting out of its range, a name that does not exist, a run that fails.
pub fn shaker_test(
    spec: &Spec,
    modes: &Modes,
    test: &ShakerTest,
    control: &Control,
) -> Result<Recording, RigError> {
    let count = check(test)?;
    let sensors = sensors(spec, modes, &test.accelerometers)?;
    let mut stream = RandomStream::new(test.seed, 0);
    let total_s = test.before_s + test.duration_s;
    let drive_courses = disturbance_courses(spec, test, total_s)?;
    let jumps = jumps(spec, test, &drive_courses);
    let time_s = |k: usize| test.before_s + k as f64 / test.rate_hz;
    let mut values = vec![Vec::with_capacity(count); sensors.len()];
    let sensor_outputs: Vec<SensorOutput> =
        sensors.iter().map(|sensor| sensor.output.clone()).collect();
    let mut from = 0;
    for (number, (at_s, start)) in jumps.iter().enumerate() {
        let until_s = jumps.get(number + 1).map_or(total_s, |jump| jump.0);
        let segment_spec = disturbed(spec, &drive_courses, *at_s);
        let end = (from..count)
            .find(|k| number + 1 < jumps.len() && time_s(*k) >= until_s)
            .unwrap_or(count);
        let times_s: Vec<f64> = (from..end).map(|k| time_s(k) - at_s).collect();
        let (kernel, trajectory) =
            integrated(&segment_spec, modes, (start, until_s - at_s), control)?;
        let read = outputs(
            &segment_spec,
            &kernel,
            &trajectory,
            &times_s,
            &sensor_outputs,
        );
        values
            .iter_mut()
            .zip(read)
            .for_each(|(all, segment_values)| all.extend(segment_values));
        from = end;
    }
    let channel = |(sensor, truth): (SensedChannel, Vec<f64>)| {
        Channel::new(
            &sensor.name,
            sensor.quantity,
            sensor.unit,
            test.sensor.read(&truth, &mut stream),
        )
    };
    let channels = sensors.into_iter().zip(values).map(channel).collect();
    let grid = Grid::even(0.0, 1.0 / test.rate_hz, count)?;
    let later_starts = jumps.iter().skip(1);
    Ok(Recording {
        name: "shaken".to_owned(),
        over: Over::Time,
        grid,
        channels,
        issues: later_starts
            .map(|(at_s, _)| jump_issue(at_s - test.before_s))
            .collect(),
    })
}

/// Courses of the drives under the disturbance of a test; empty without one.
fn disturbance_courses(
    spec: &Spec,
    test: &ShakerTest,
    total_s: f64,
) -> Result<Vec<(String, DriveCourse)>, RigError> {
    if test.disturbance == Disturbance::NONE {
        return Ok(Vec::new());
    }
    if let Some(base) = spec.bases().first() {
        return Err(RigError::Bases {
            base: (*base).to_owned(),
            what: "a shaker that wanders",
        });
    }
    let mut stream = RandomStream::new(test.seed, 1);
    Ok(drive_courses(spec, &test.disturbance, total_s, &mut stream))
}

fn jump_issue(at_s: f64) -> Issue {
    let message = format!(
        "the motion continues from another solution at {at_s:.6} s: simulated, the cause of the \
        jump is not modelled"
    );
    Issue::new(IssueKind::Simulated, 1, None, message)
}

fn check(test: &ShakerTest) -> Result<usize, RigError> {
    test.sensor.check()?;
    test.disturbance.check()?;
    let samples = test.duration_s * test.rate_hz;
    if !(64.0..=4e6).contains(&samples) {
        return Err(RigError::Setting {
            name: "the number of samples, rate times duration,",
            value: samples,
            allowed: "from 64 to 4000000: change the rate, or the duration of the record",
        });
    }
    let ordered = test.starts.windows(2).all(|pair| pair[0].0 < pair[1].0);
    match test
        .starts
        .iter()
        .find(|(at_s, _)| !ordered || !(0.0..test.duration_s).contains(at_s))
    {
        Some((at_s, _)) => Err(RigError::Setting {
            name: "the time of a solution in seconds",
            value: *at_s,
            allowed: "within the record, later than the previous time",
        }),
        None => Ok(samples.round() as usize),
    }
}

fn integrated(
    spec: &Spec,
    modes: &Modes,
    (start, duration_s): (&StartState, f64),
    control: &Control,
) -> Result<(Kernel, Trajectory), RigError> {
    let mut system = System::assemble(spec, modes.clone())?;
    let mut start = start.clone();
    // Disturbed drives are not sinusoids.
    start.drive_angle_rad.truncate(system.drives.len());
    system
        .drives
        .iter_mut()
        .zip(&start.drive_angle_rad)
        .for_each(|(drive, angle)| drive.phase_rad = *angle);
    let kernel = Kernel::new(Plant::new(system)?)?.with_control(control);
    let plan = RunPlan {
        duration_s,
        average_over_s: duration_s,
        tolerance: spec.run.tolerance,
        record_s: duration_s,
    };
    let run = simulate(&kernel, &start, &plan)?;
    Ok((kernel, run.trajectory))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests;
