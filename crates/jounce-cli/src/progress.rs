//! Progress of long work on stderr: rate and time left, only where stderr is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use jounce::march::Watch;
use std::time::Duration;

/// Time between two looks at a counter.
const LOOK: Duration = Duration::from_millis(100);

/// A bar for a number of points.
pub fn bar(points: usize) -> ProgressBar {
    counted(points, "points")
}

/// A bar for a number of things of one name.
pub fn counted(things: usize, name: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(things as u64), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template(&format!("{{bar:30}} {{pos}}/{{len}} {name}  {{per_sec}}  {{eta}} left  {{msg}}"));
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Shows what a watch counts while `work` runs: curves have no length that is known before their end, so there is no time left.
pub fn watched<T>(watch: &Watch, work: impl FnOnce() -> T) -> T {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{spinner} {pos} orbits tried  {per_sec}  {elapsed} so far");
    let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    let (end, ended) = std::sync::mpsc::channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            while ended.recv_timeout(LOOK) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
                bar.set_position(watch.harvesters());
            }
            bar.finish_and_clear();
        });
        let answer = work();
        drop(end);
        answer
    })
}
