//! Recordings: samples of a drive in a CSV file.
//!
//! The first two columns hold times in s and values. Lines that begin with `#` and a first line of names are passed over.
//! Samples must be even: each lies within [`JITTER`] of a sampling step of its place, so that times with few digits pass and a sample
//! that is missing does not.

use std::path::Path;
use std::sync::Arc;

/// How far a time may lie from its place, in sampling steps.
const JITTER: f64 = 0.1;

/// How far the rate of a file may lie from the rate that the spec names, relative.
const RATE_ERROR: f64 = 1e-3;

/// The largest file, bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Samples at even times.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Time between samples, s.
    pub step_s: f64,
    /// The values as they stand in the file, at least two.
    pub values: Arc<[f64]>,
}

impl Recording {
    /// Reads a file; where a rate is given it must be that of the file.
    ///
    /// # Errors
    /// One sentence with the file, the lines and what to do.
    pub(super) fn read(path: &Path, sample_rate_hz: Option<f64>) -> Result<Self, String> {
        let shown = path.display();
        let metadata = std::fs::metadata(path).map_err(|error| format!("{shown} cannot be read: {error}"))?;
        if !metadata.is_file() {
            return Err(format!("{shown} is no file; name the CSV file with the recording"));
        }
        if metadata.len() > MOST_BYTES {
            return Err(format!("{shown} is larger than 1 GiB; cut the recording into pieces"));
        }
        let text = std::fs::read_to_string(path).map_err(|error| format!("{shown} cannot be read: {error}"))?;
        Self::from_csv(&text, sample_rate_hz).map_err(|message| format!("{shown}, {message}"))
    }

    fn from_csv(text: &str, sample_rate_hz: Option<f64>) -> Result<Self, String> {
        let (lines, times_s, values) = samples(text)?;
        let [Some(first_s), Some(last_s)] = [times_s.first().copied(), times_s.last().copied()] else {
            return Err("which holds no samples; two columns are due, times in s and values".to_owned());
        };
        if times_s.len() < 2 {
            return Err("which holds one sample; at least two are due".to_owned());
        }
        if let Some(k) = (1..times_s.len()).find(|k| times_s[*k] <= times_s[k - 1]) {
            return Err(format!("line {}: the time {} s is not after {} s; times must ascend", lines[k], times_s[k], times_s[k - 1]));
        }
        // The middle of all steps: a gap does not move it.
        let mut steps: Vec<f64> = times_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        let usual_s = steps[steps.len() / 2];
        if let Some(k) = (1..times_s.len()).find(|k| times_s[*k] - times_s[k - 1] > 1.5 * usual_s) {
            return Err(format!(
                "line {}: a gap of {:.6e} s after {} s, where samples are {usual_s:.6e} s apart; fill it in or cut the recording there",
                lines[k],
                times_s[k] - times_s[k - 1],
                times_s[k - 1]
            ));
        }
        let step_s = (last_s - first_s) / (times_s.len() - 1) as f64;
        let off = |k: usize| (times_s[k] - first_s) / step_s - k as f64;
        if let Some(k) = (0..times_s.len()).find(|k| off(*k).abs() > JITTER) {
            if let Some(k) = change(&times_s) {
                let [before_s, after_s] = [k - 1, k].map(|k| times_s[k + 1] - times_s[k]);
                return Err(format!(
                    "line {}: samples are {before_s:.6e} s apart before it and {after_s:.6e} s after it; sample the recording anew at one rate",
                    lines[k]
                ));
            }
            return Err(format!(
                "line {}: the time {} s is {:.2} of a sample away from its place at an even {:.6} Hz; sample the recording anew at one rate",
                lines[k],
                times_s[k],
                off(k).abs(),
                1.0 / step_s
            ));
        }
        if let Some(wanted_hz) = sample_rate_hz.filter(|wanted_hz| (wanted_hz * step_s - 1.0).abs() > RATE_ERROR) {
            return Err(format!("which is sampled at {:.6} Hz, not at `sample_rate` = {wanted_hz} Hz; correct one of them", 1.0 / step_s));
        }
        Ok(Self { step_s: sample_rate_hz.map_or(step_s, |rate_hz| 1.0 / rate_hz), values: values.into() })
    }
}

/// Where even samples change their step for good, which fits the mean step nowhere.
fn change(times_s: &[f64]) -> Option<usize> {
    let step_s = |k: usize| times_s[k + 1] - times_s[k];
    let same = |a: usize, b: usize| (step_s(a) - step_s(b)).abs() <= 0.1 * JITTER * (step_s(a) + step_s(b));
    let last = times_s.len() - 2;
    let from = (1..=last).find(|k| !same(k - 1, *k))?;
    ((1..from).all(|k| same(0, k)) && (from..=last).all(|k| same(from, k)) && from > 1 && from < last).then_some(from)
}

/// Faults of single lines that are told at most.
const MOST_FAULTS: usize = 8;

/// Line, time and value of each sample.
type Samples = (Vec<u64>, Vec<f64>, Vec<f64>);

/// What separates the columns where it is no comma, with its line: of the second line that is no comment, as the first may be a title.
fn other_separator(text: &str) -> Option<(usize, &'static str)> {
    let lines = || text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (index, line) = lines().nth(1).or_else(|| lines().next())?;
    let within = |separator: char| line.trim().contains(separator);
    let name = match (within(';'), within(',')) {
        (true, _) => "semicolons",
        (false, true) => return None,
        _ if within('\t') => "tabs",
        _ if within(' ') => "spaces",
        _ => return None,
    };
    Some((index + 1, name))
}

fn samples(text: &str) -> Result<Samples, String> {
    if let Some((line, name)) = other_separator(text) {
        return Err(format!("line {line}: columns are separated by {name}; commas are due, and decimal points"));
    }
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    let (mut lines, mut times_s, mut values) = (Vec::new(), Vec::new(), Vec::new());
    let mut faults: Vec<String> = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let record = record.map_err(|error| format!("which is no CSV: {error}"))?;
        let line = record.position().map_or(index as u64 + 1, csv::Position::line);
        let field = |column: usize, what: &str| -> Result<f64, String> {
            let Some(text) = record.get(column) else {
                return Err(format!("line {line}: the {what} is missing; two columns are due, times in s and values"));
            };
            let number = text.parse::<f64>().map_err(|_| format!("line {line}: the {what} {text:?} is no number"))?;
            if number.is_finite() {
                Ok(number)
            } else {
                Err(format!("line {line}: the {what} is {text}; fill in or cut out what is not finite"))
            }
        };
        let is_header = index == 0 && record.get(0).is_some_and(|text| text.parse::<f64>().is_err());
        if is_header {
            continue;
        }
        match (field(0, "time"), field(1, "value")) {
            (Ok(time_s), Ok(value)) => {
                lines.push(line);
                times_s.push(time_s);
                values.push(value);
            }
            (time, value) => faults.extend([time.err(), value.err()].into_iter().flatten()),
        }
        if faults.len() >= MOST_FAULTS {
            faults.push("and perhaps more".to_owned());
            break;
        }
    }
    if faults.is_empty() { Ok((lines, times_s, values)) } else { Err(faults.join("; ")) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Twenty samples, the steps of which grow by a tenth after a line.
    fn slower_from(line: u32) -> String {
        (1..=20_u32).map(|k| format!("{:.6},{k}\n", 1e-3 * f64::from(k) + 1e-4 * f64::from(k.saturating_sub(line)))).collect()
    }

    fn even(count: u32) -> String {
        (0..count).map(|k| format!("{:.6},{}\n", f64::from(k) / 3000.0, k * k)).collect()
    }

    #[test]
    fn rounded_times_are_even_and_headers_are_passed_over() {
        let found = Recording::from_csv(&format!("# from a shaker\ntime_s,a\n{}", even(1000)), None).unwrap();
        assert!((found.step_s * 3000.0 - 1.0).abs() < 1e-5 && found.values.len() == 1000 && found.values[3] == 9.0, "{}", found.step_s);
        assert_eq!(Recording::from_csv(&even(1000), Some(3000.0)).unwrap().step_s, 1.0 / 3000.0);
    }

    #[test]
    fn each_fault_is_told_with_its_line() {
        let without =
            |line: usize| even(20).lines().enumerate().filter(|(k, _)| *k != line).map(|(_, l)| format!("{l}\n")).collect::<String>();
        for (text, rate_hz, message) in [
            (even(20).replace(",25\n", ",nan\n"), None, "line 6: the value is nan; fill in or cut out what is not finite"),
            (even(20).replace(",25\n", ",x\n"), None, "line 6: the value \"x\" is no number"),
            (even(20).replace(",25\n", "\n"), None, "line 6: the value is missing"),
            (without(7), None, "line 8: a gap of 6.67"),
            (even(20).replace("0.001667", "0.001567"), None, "line 6: the time 0.001567 s is 0.30 of a sample away"),
            (even(20).replace("0.001667", "0.001333"), None, "line 6: the time 0.001333 s is not after 0.001333 s; times must ascend"),
            (even(20), Some(2000.0), "which is sampled at 3000"),
            (
                even(20).replace(",25\n", ",x\n").replace(",49\n", "\n"),
                None,
                "no number; line 8: the value is missing; two columns are due",
            ),
            (slower_from(12), None, "line 12: samples are 1.000000e-3 s apart before it and 1.100000e-3 s after it"),
            (even(20).replace(',', "\t"), None, "line 2: columns are separated by tabs; commas are due"),
            (format!("# t a\nt a\n{}", even(20).replace(',', " ")), None, "line 3: columns are separated by spaces; commas are due"),
            ("0,1;0,2\n0,2;0,3\n".to_owned(), None, "line 2: columns are separated by semicolons; commas are due"),
            ("1,2\n".to_owned(), None, "which holds one sample"),
            ("t,a\n".to_owned(), None, "which holds no samples"),
        ] {
            let found = Recording::from_csv(&text, rate_hz).unwrap_err();
            assert!(found.contains(message), "{message}: {found}");
        }
    }
}
