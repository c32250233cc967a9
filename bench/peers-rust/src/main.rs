//! One run of one Rust peer: `peers PLANT METHOD TOLERANCE ABSOLUTE` prints one JSON line; `cpu_s` is the integration alone.

mod dop853;
mod implicit;
mod plant;

use plant::Plant;
use std::process::ExitCode;

/// What a peer found, and how many right-hand sides it took.
pub struct Outcome {
    mean_power_w: f64,
    evaluations: u64,
}

fn cpu_s() -> f64 {
    let mut now = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: `now` is a valid timespec and the clock exists on every Linux.
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut now) };
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

fn march<const M: usize, const N: usize>(
    path: &str,
    method: &str,
    tolerance: f64,
    absolute: f64,
) -> Result<String, String> {
    let plant = Plant::<M>::read(path)?;
    let once = |plant: &Plant<M>| match method {
        "dop853" => dop853::march::<M, N>(plant, tolerance, absolute),
        other => implicit::march(plant, other, tolerance, absolute),
    };
    let warm = Plant::<M> {
        duration_s: 0.05 * plant.duration_s,
        average_over_s: 0.05 * plant.average_over_s,
        ..Plant::read(path)?
    };
    once(&warm)?;
    let start = cpu_s();
    let outcome = once(&plant)?;
    let taken_s = cpu_s() - start;
    Ok(format!(
        r#"{{"mean_power_w": {:e}, "cpu_s": {taken_s:e}, "evaluations": {}}}"#,
        outcome.mean_power_w, outcome.evaluations
    ))
}

fn run(words: &[String]) -> Result<String, String> {
    let [path, method, tolerance, absolute] = words else {
        return Err("usage: peers PLANT METHOD TOLERANCE ABSOLUTE".into());
    };
    let number = |word: &String| word.parse::<f64>().map_err(|e| format!("'{word}': {e}"));
    let (tolerance, absolute) = (number(tolerance)?, number(absolute)?);
    match plant::modes(path)? {
        8 => march::<8, 18>(path, method, tolerance, absolute),
        24 => march::<24, 50>(path, method, tolerance, absolute),
        other => Err(format!("{other} modes; this peer is compiled for 8 and 24")),
    }
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match run(&words) {
        Ok(line) => println!("{line}"),
        Err(message) => println!(r#"{{"failed": {message:?}}}"#),
    }
    ExitCode::SUCCESS
}
