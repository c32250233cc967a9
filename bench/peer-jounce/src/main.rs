//! Runs of jounce as a library: `peer-jounce SPEC warm|first|each|balance|orbits KEY=VALUE...` prints JSON lines.
//!
//! Keys of the spec are set as with `--set` on the command line, as in `"drive.shaker.frequency=11 Hz"`.
//! `cpu_s` is CPU time of the one thread that works during `simulate`, from a fresh state at rest to the result; under a limit of CPU time
//! that of a process moves by ticks of 4 ms on some kernels. With `first`
//! nothing was run before. With `warm` the same run was done before on the same kernel, so that its step tables are there, as for
//! every run of a sweep but its first; a millisecond being short, it is repeated many times, and the times are those of the median.
//! `wall_s` is the wall time of the same run, `wall_time_s` that of the integration alone.
//!
//! With `balance` the branch of period 1 is followed upwards from 10.5 to 12 Hz by the equations of harmonic balance alone, with 64 harmonics,
//! without stability and without the integration that checks them: `points` and the CPU time of all, the median of many walks. With `orbits` the
//! same walk makes an orbit of every point: its multipliers and its error by the exact flow.
//!
//! With `each` the run is done before and once for every line on stdin. `simulate_s` is the wall time of `simulate`, `run_s` that of
//! all that the command `run` asks of the library once a spec is prepared: the kernel of the run, `simulate`, peak voltages, charges and
//! warnings.

use jounce_analysis::{Model, Parameter, settled_orbit};
use jounce_continuation::{Continuation, Corrector, Direction, Metric, Position, StepControl, correct_at, tangent};
use jounce_control::Control;
use jounce_dynamics::Kernel;
use jounce_orbits::{HarmonicBalance, OrbitMethod, ParametricModel, Shooting};
use jounce_model::plant::{Plant, System};
use jounce_analysis::run::{RunPlan, RunResult, StartState, Warning, charges, simulate, voltage_peaks};
use jounce_spec::{NumericKey, Spec, SpecFile};
use jounce_model::structure;
use rustix::time::{ClockId, clock_gettime};
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

fn cpu_s() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

fn read(path: &str, changes: &[String]) -> Result<Spec, Box<dyn Error>> {
    let mut file = SpecFile::read(path)?;
    for change in changes {
        let (key, value) = change
            .split_once('=')
            .ok_or_else(|| format!("'{change}' is not KEY=VALUE"))?;
        file.set(key, value)?;
    }
    Ok(file.spec()?)
}

/// Warm runs in one process.
const RUNS: usize = 25;

/// One run of a kernel, or the median of many after it.
fn simulation_timing(spec: &Spec, is_warm: bool) -> Result<String, Box<dyn Error>> {
    let kernel = Kernel::new(Plant::new(System::assemble(
        spec,
        structure::modes(spec)?,
    )?)?)?;
    let rest = StartState::rest(&kernel.plant);
    let plan = RunPlan::of(&spec.run, 0.0);
    let timed = || -> Result<[f64; 4], Box<dyn Error>> {
        let (begun, before_s) = (Instant::now(), cpu_s());
        let RunResult {
            mean_power_w,
            wall_time_s,
            ..
        } = simulate(&kernel, &rest, &plan)?;
        Ok([
            cpu_s() - before_s,
            begun.elapsed().as_secs_f64(),
            wall_time_s,
            mean_power_w,
        ])
    };
    let mut runs = vec![timed()?];
    if is_warm {
        runs = (0..RUNS).map(|_| timed()).collect::<Result<_, _>>()?;
        runs.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    let [duration_s, wall_s, wall_time_s, mean_power_w] = runs[runs.len() / 2];
    Ok(format!(
        r#"{{"mean_power_w": {mean_power_w:e}, "cpu_s": {duration_s:e}, "wall_s": {wall_s:e}, "wall_time_s": {wall_time_s:e}}}"#
    ))
}

/// All that the command `run` asks of the library for a prepared harvester.
fn command_timing(prepared: &Model) -> Result<String, Box<dyn Error>> {
    let begun = Instant::now();
    let model = prepared.with_control(&Control::default())?;
    let start = model.start(Path::new(""))?;
    let kernel = model.from_state(&start)?;
    let plan = RunPlan::of(&model.spec.run, 0.0)
        .watching(&model.spec, &kernel.plant)
        .balancing(&kernel.plant);
    let before_s = begun.elapsed().as_secs_f64();
    let result = simulate(&kernel, &start, &plan)?;
    let simulate_s = begun.elapsed().as_secs_f64() - before_s;
    black_box(Warning::of(&model.spec, &kernel, &plan, &result));
    black_box((
        voltage_peaks(&kernel, &result, &plan),
        charges(&kernel, &result, &plan),
    ));
    let (
        run_s,
        RunResult {
            mean_power_w,
            wall_time_s,
            ..
        },
    ) = (begun.elapsed().as_secs_f64(), result);
    Ok(format!(
        r#"{{"mean_power_w": {mean_power_w:e}, "run_s": {run_s:e}, "simulate_s": {simulate_s:e}, "wall_time_s": {wall_time_s:e}}}"#
    ))
}

/// Range of the walk by harmonic balance, Hz, and its harmonics.
const WALKED_HZ: [f64; 2] = [10.5, 12.0];
const HARMONICS: usize = 64;

/// A walk by the equations of harmonic balance alone, or with the orbit of each point.
fn balance(spec: Spec, with_orbits: bool) -> Result<String, Box<dyn Error>> {
    let key = NumericKey::find(&spec, "drive.shaker.frequency")?;
    let base = Model::new(spec)?;
    let [low_hz, high_hz] = WALKED_HZ;
    let parameter = Parameter::new(&base, &key, high_hz - low_hz);
    let corrector = Corrector {
        goal: 5e-8,
        most: 8,
    };
    let kernel = parameter.at(low_hz)?.kernel;
    let rest = vec![0.0; kernel.plant.len()];
    let orbit = settled_orbit(&parameter, low_hz, &rest, 1e-9, corrector.goal)
        .ok_or("nothing settles at the start")?;
    let method = HarmonicBalance::new(
        Shooting::new(&parameter, &kernel, 1, 1e-9),
        &kernel,
        HARMONICS,
        0.0,
    )?;
    let guess = Position {
        unknown: method.unknown_of(orbit.start(), low_hz)?,
        parameter: low_hz,
    };
    let scale = (high_hz - low_hz) / 20.0;
    let metric = Metric::at(&guess, scale);
    let up = Direction {
        unknown: vec![0.0; guess.unknown.len()],
        parameter: 1.0,
    };
    let mut walks = Vec::new();
    for _ in 0..RUNS {
        let first = correct_at(&method, &corrector, &metric, guess.clone())?;
        let direction = tangent(&first.local, &metric, &up).ok_or("no tangent at the start")?;
        let mut walk = Continuation::new(
            &method,
            corrector,
            StepControl::default(),
            scale,
            first.position,
            direction,
        );
        let (before_s, mut points) = (cpu_s(), 0);
        while walk.position.parameter < high_hz {
            let step = walk.next().ok_or("the walk ended")??;
            if with_orbits {
                black_box(method.orbit(&step.local, step.error)?);
            }
            points += 1;
        }
        walks.push((cpu_s() - before_s, points));
    }
    walks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (duration_s, points) = walks[walks.len() / 2];
    Ok(format!(r#"{{"points": {points}, "cpu_s": {duration_s:e}}}"#))
}

fn measure(path: &str, start: &str, changes: &[String]) -> Result<(), Box<dyn Error>> {
    let spec = read(path, changes)?;
    match start {
        "warm" | "first" => println!("{}", simulation_timing(&spec, start == "warm")?),
        "each" => {
            let model = Model::new(spec)?;
            command_timing(&model)?;
            for line in std::io::stdin().lines() {
                line?;
                println!("{}", command_timing(&model)?);
            }
        }
        "balance" | "orbits" => println!("{}", balance(spec, start == "orbits")?),
        other => {
            return Err(
                format!("'{other}' is neither warm, first, each, balance nor orbits").into(),
            );
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [path, start, changes @ ..] = words.as_slice() else {
        eprintln!("usage: peer-jounce SPEC warm|first|each|balance|orbits KEY=VALUE...");
        return ExitCode::from(2);
    };
    if let Err(error) = measure(path, start, changes) {
        println!(r#"{{"failed": {:?}}}"#, error.to_string());
    }
    ExitCode::SUCCESS
}
