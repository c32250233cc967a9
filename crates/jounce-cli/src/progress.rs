//! Progress of long work on stderr, with rate and time left: a bar on a terminal, else a line every
//! ten seconds.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use jounce::Control;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Time between two readings of a counter.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// Time between two plain lines.
const LINE_INTERVAL: Duration = Duration::from_secs(10);

/// Returns a bar for a number of items of one name.
pub fn counting_bar(length: usize, name: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template(&format!(
        "{{bar:30}} {{pos}}/{{len}} {name}  {{per_sec}}  {{eta}} left  {{msg}}"
    ));
    let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    lines_without_terminal(&bar, name);
    bar
}

/// Shows the finished parts that a control counts, of one name, while `work` runs.
pub fn with_parts<T>(name: &'static str, control: &Control, work: impl FnOnce() -> T) -> T {
    let bar = counting_bar(0, name);
    set_parts(&bar, control);
    with_polling(bar, &|bar| set_parts(bar, control), work)
}

/// Shows the finished percentage of the parts that a control counts, with its unit, while `work` runs.
pub fn with_percent<T>(unit: &'static str, control: &Control, work: impl FnOnce() -> T) -> T {
    let update = |bar: &ProgressBar| {
        let (done, expected) = control.progress();
        bar.set_position(100 * done / expected.max(1));
    };
    with_polling(counting_bar(100, unit), &update, work)
}

fn set_parts(bar: &ProgressBar, control: &Control) {
    let (done, expected) = control.progress();
    bar.set_length(expected);
    bar.set_position(done);
}

/// Shows the orbits that a control counts while `work` runs. The length of curves is not known in
/// advance, so no time left is shown.
pub fn with_progress<T>(control: &Control, work: impl FnOnce() -> T) -> T {
    with_count("orbits computed", &|| control.harvesters(), work)
}

/// Shows a count of items of one name, without a known end, while `work` runs.
pub fn with_count<T>(
    name: &'static str,
    count: &(dyn Fn() -> u64 + Sync),
    work: impl FnOnce() -> T,
) -> T {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template(&format!(
        "{{spinner}} {{pos}} {name}  {{per_sec}}  {{elapsed}} so far"
    ));
    let bar = bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    lines_without_terminal(&bar, name);
    with_polling(bar, &|bar| bar.set_position(count()), work)
}

/// Updates a bar while `work` runs.
fn with_polling<T>(
    bar: ProgressBar,
    update: &(dyn Fn(&ProgressBar) + Sync),
    work: impl FnOnce() -> T,
) -> T {
    let (finish_sender, finish_receiver) = std::sync::mpsc::channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            while finish_receiver.recv_timeout(POLL_INTERVAL)
                == Err(std::sync::mpsc::RecvTimeoutError::Timeout)
            {
                update(&bar);
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(finish_sender);
        result
    })
}

fn lines_without_terminal(bar: &ProgressBar, name: &'static str) {
    if !std::io::stderr().is_terminal() {
        // A closed stderr does not end the work.
        print_lines(bar, name, LINE_INTERVAL, |line| {
            drop(writeln!(std::io::stderr(), "{line}"))
        });
    }
}

/// Prints a line about a bar at intervals, from a thread that ends with the bar.
fn print_lines(
    bar: &ProgressBar,
    name: &'static str,
    interval: Duration,
    write_line: impl Fn(String) + Send + 'static,
) {
    let bar = bar.downgrade();
    std::thread::spawn(move || {
        let clock = Instant::now();
        let (mut next_report, mut first_position) = (interval, None);
        loop {
            std::thread::sleep(POLL_INTERVAL.min(interval));
            let Some(bar) = bar.upgrade().filter(|bar| !bar.is_finished()) else {
                return;
            };
            // Work of an earlier run does not count in the rate.
            let first_position = *first_position.get_or_insert(bar.position());
            if clock.elapsed() >= next_report {
                next_report += interval;
                write_line(line(
                    name,
                    bar.position(),
                    first_position,
                    bar.length(),
                    clock.elapsed(),
                ));
            }
        }
    });
}

/// Formats `"120 of 400 points, 12 per s, 23 s left"`; without an end `"120 orbits computed, 12 per
/// s, 10 s so far"`.
fn line(
    name: &str,
    position: u64,
    first_position: u64,
    length: Option<u64>,
    elapsed: Duration,
) -> String {
    let seconds = elapsed.as_secs_f64();
    let rate = position.saturating_sub(first_position) as f64 / seconds;
    let per_s = if rate >= 1.0 || rate == 0.0 {
        format!("{rate:.0} per s")
    } else {
        format!("{:.0} s each", 1.0 / rate)
    };
    match length {
        None => format!("{position} {name}, {per_s}, {seconds:.0} s so far"),
        Some(length) if rate == 0.0 => {
            format!("{position} of {length} {name}, {seconds:.0} s so far")
        }
        Some(length) => format!(
            "{position} of {length} {name}, {per_s}, {:.0} s left",
            length.saturating_sub(position) as f64 / rate
        ),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn a_line_holds_rate_and_remaining_time() {
        let line_at = |position, first_position, length, seconds| {
            line(
                "points",
                position,
                first_position,
                length,
                Duration::from_secs(seconds),
            )
        };
        assert_eq!(
            line_at(220, 100, Some(400), 10),
            "220 of 400 points, 12 per s, 15 s left"
        );
        assert_eq!(
            line_at(5, 0, Some(6), 20),
            "5 of 6 points, 4 s each, 4 s left"
        );
        assert_eq!(line_at(3, 3, Some(400), 10), "3 of 400 points, 10 s so far");
        assert_eq!(line_at(50, 0, None, 10), "50 points, 5 per s, 10 s so far");
    }

    /// Lines are printed until the bar is finished, and hold no control characters.
    #[test]
    fn lines_are_printed_until_the_bar_is_finished() {
        let (sender, receiver) = std::sync::mpsc::channel();
        let bar = ProgressBar::with_draw_target(Some(10), ProgressDrawTarget::hidden());
        print_lines(&bar, "points", Duration::from_millis(20), move |line| {
            drop(sender.send(line))
        });
        let first_line = receiver.recv_timeout(Duration::from_secs(60)).unwrap();
        bar.inc(4);
        // Some lines may have been printed before.
        let later_line = std::iter::from_fn(|| receiver.recv_timeout(Duration::from_secs(60)).ok())
            .find(|line| !line.starts_with("0 of 10"));
        assert!(
            first_line.starts_with("0 of 10 points")
                && later_line
                    .as_ref()
                    .is_some_and(|line| line.starts_with("4 of 10 points")),
            "{later_line:?}"
        );
        assert!(
            later_line
                .iter()
                .all(|line| line.chars().all(|c| !c.is_control()))
        );
        bar.finish_and_clear();
        // The channel closes when the thread ends.
        while let Ok(line) = receiver.recv_timeout(Duration::from_secs(60)) {
            assert!(line.contains("points"));
        }
        assert_eq!(
            receiver.recv_timeout(Duration::from_millis(1)),
            Err(std::sync::mpsc::RecvTimeoutError::Disconnected)
        );
    }
}
