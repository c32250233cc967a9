//! One run of jounce as a library: `peer-jounce SPEC warm|first KEY=VALUE...` prints one JSON line.
//!
//! Keys of the spec are set as with `--set` on the command line, as in `"drive.shaker.frequency=11 Hz"`.
//! `cpu_s` is CPU time of the one thread that works during `simulate`, from a fresh state at rest to the answer; under a limit of CPU time
//! that of a process moves by ticks of 4 ms on some kernels. With `warm` the same
//! run was marched before on the same kernel, so that its step tables are there, as for every run of a sweep but its first. With `first`
//! nothing was marched before. `wall_s` is the wall time of the same, `march_s` that of the march alone.

use jounce::march::Kernel;
use jounce::plant::{Plant, System};
use jounce::run::{RunAnswer, RunPlan, StartState, simulate};
use jounce::spec::SpecFile;
use jounce::structure;
use rustix::time::{ClockId, clock_gettime};
use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

fn cpu_s() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

fn measure(path: &str, start: &str, changes: &[String]) -> Result<String, Box<dyn Error>> {
    let mut file = SpecFile::read(path)?;
    for change in changes {
        let (key, value) = change.split_once('=').ok_or_else(|| format!("'{change}' is not KEY=VALUE"))?;
        file.set(key, value)?;
    }
    let spec = file.spec()?;
    let kernel = Kernel::new(Plant::new(System::assemble(&spec, structure::modes(&spec)?)?)?)?;
    let rest = StartState::rest(&kernel.plant);
    let whole = RunPlan {
        duration_s: spec.run.duration_s,
        average_over_s: spec.run.average_over_s,
        tolerance: spec.run.tolerance,
        record_s: 0.0,
    };
    match start {
        "warm" => drop(simulate(&kernel, &rest, &whole)?),
        "first" => {}
        other => return Err(format!("'{other}' is neither warm nor first").into()),
    }
    let (begun, before_s) = (Instant::now(), cpu_s());
    let RunAnswer { mean_power_w, march_s, .. } = simulate(&kernel, &rest, &whole)?;
    let (taken_s, wall_s) = (cpu_s() - before_s, begun.elapsed().as_secs_f64());
    Ok(format!(r#"{{"mean_power_w": {mean_power_w:e}, "cpu_s": {taken_s:e}, "wall_s": {wall_s:e}, "march_s": {march_s:e}}}"#))
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [path, start, changes @ ..] = words.as_slice() else {
        eprintln!("usage: peer-jounce SPEC warm|first KEY=VALUE...");
        return ExitCode::from(2);
    };
    match measure(path, start, changes) {
        Ok(line) => println!("{line}"),
        Err(error) => println!(r#"{{"failed": {:?}}}"#, error.to_string()),
    }
    ExitCode::SUCCESS
}
