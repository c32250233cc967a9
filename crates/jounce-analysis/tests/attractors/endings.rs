//! Brute-force integrations of all starts of a cloud, with a file of results from which an interrupted
//! comparison continues.

use crate::brute::{Ending, Flow, Kind, Patience, ReferenceModel, classify};
use jounce_model::plant::System;
use rayon::prelude::*;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Effort of the integrations.
#[derive(Debug, Clone)]
pub struct Effort {
    pub patience: Patience,
    /// Error of a step, relative to the size of the motion.
    pub tolerance: f64,
    /// File for the result of each start.
    pub results: Option<PathBuf>,
    /// Endings of the first starts, known from an earlier integration.
    pub known: Vec<Ending>,
}

impl Effort {
    /// Effort without a file and without known endings.
    pub fn new(patience: Patience, tolerance: f64) -> Self {
        Self {
            patience,
            tolerance,
            results: None,
            known: Vec::new(),
        }
    }

    /// Same effort with a larger error per step, for repeated integrations.
    pub fn with_larger_error(&self, factor: f64) -> Self {
        Self::new(self.patience, factor * self.tolerance)
    }
}

/// Returns the endings of all starts of a cloud, by brute force where they are not known.
pub fn endings(system: &System, starts: &[Vec<f64>], effort: &Effort) -> Vec<Ending> {
    let known = effort.known.len().min(starts.len());
    let mut all = effort.known[..known].to_vec();
    all.extend(integrated(system, &starts[known..], effort));
    all
}

fn integrated(system: &System, starts: &[Vec<f64>], effort: &Effort) -> Vec<Ending> {
    match system.modes.len() {
        1 => endings_of::<1, 4>(system, starts, effort),
        2 => endings_of::<2, 6>(system, starts, effort),
        3 => endings_of::<3, 8>(system, starts, effort),
        _ => endings_of::<8, 18>(system, starts, effort),
    }
}

fn endings_of<const N: usize, const D: usize>(
    system: &System,
    starts: &[Vec<f64>],
    effort: &Effort,
) -> Vec<Ending> {
    let model = ReferenceModel::<N, D>::of(system);
    let known = effort.results.as_deref().map_or(Vec::new(), read);
    let file = effort
        .results
        .as_deref()
        .map(|path| Mutex::new(append(path)));
    let flow = Flow {
        model: &model,
        tolerance: effort.tolerance,
        has_series: true,
    };
    let ending = |start: &Vec<f64>| {
        let key = key(start, effort);
        if let Some((_, ending)) = known.iter().find(|(known, _)| *known == key) {
            return ending.clone();
        }
        let ending = classify(flow, start, effort.patience);
        if let Some(file) = &file {
            writeln!(file.lock().unwrap(), "{key};{};", line(&ending)).unwrap();
        }
        ending
    };
    starts.par_iter().map(ending).collect()
}

fn append(path: &Path) -> File {
    OpenOptions::new()
        .create(true)
        .append(true)
        .open(path)
        .unwrap()
}

/// Text that identifies an integration: its limits and its start.
fn key(start: &[f64], effort: &Effort) -> String {
    let Patience { cycles, period } = effort.patience;
    format!("{cycles} {period} {:e} {}", effort.tolerance, list(start))
}

/// Numbers with all their digits.
fn list(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|value| format!("{value:e}")).collect();
    texts.join(" ")
}

/// Returns an ending as text.
pub fn line(ending: &Ending) -> String {
    let kind = match ending.kind {
        Kind::Periodic(period) => format!("periodic {period}"),
        Kind::Torus => "torus".into(),
        Kind::Chaos => "chaos".into(),
        Kind::Unsettled => "unsettled".into(),
        Kind::Lost => "lost".into(),
    };
    let numbers = [ending.mean_power_w, ending.size, ending.power_scale_w];
    let exponent = ending
        .exponent
        .map_or(String::new(), |exponent| list(&exponent));
    let states: Vec<String> = ending.strobe.iter().map(|state| list(state)).collect();
    let (numbers, cycles) = (list(&numbers), ending.cycles);
    format!("{kind};{numbers};{exponent};{cycles};{}", states.join(","))
}

/// Complete lines of a file; the last one may have been cut off.
fn read(path: &Path) -> Vec<(String, Ending)> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    text.lines().filter_map(parsed).collect()
}

fn parsed(line: &str) -> Option<(String, Ending)> {
    let (key, ending) = line.strip_suffix(';')?.split_once(';')?;
    Some((key.into(), ending_of(ending)?))
}

/// Reads an ending from its text; `None` where the text was cut off.
pub fn ending_of(text: &str) -> Option<Ending> {
    let fields: Vec<&str> = text.split(';').collect();
    let [kind, numbers, exponent, cycles, states] = fields[..] else {
        return None;
    };
    let values = |text: &str| -> Vec<f64> {
        text.split_whitespace()
            .map(|value| value.parse().unwrap())
            .collect()
    };
    let kind = match kind.split_once(' ') {
        Some((_, period)) => Kind::Periodic(period.parse().ok()?),
        None if kind == "torus" => Kind::Torus,
        None if kind == "chaos" => Kind::Chaos,
        None if kind == "unsettled" => Kind::Unsettled,
        None => Kind::Lost,
    };
    let [mean_power_w, size, power_scale_w] = values(numbers)[..] else {
        return None;
    };
    Some(Ending {
        kind,
        mean_power_w,
        strobe: states.split(',').map(values).collect(),
        size,
        power_scale_w,
        exponent: values(exponent).try_into().ok(),
        cycles: cycles.parse().ok()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ending(kind: Kind, exponent: Option<[f64; 2]>) -> Ending {
        Ending {
            kind,
            mean_power_w: 0.1 + 0.2,
            strobe: vec![vec![1.0 / 3.0, -2e-300], vec![0.0, 5e7 / 3.0]],
            size: 7.0_f64.sqrt(),
            power_scale_w: 1e-9 / 7.0,
            exponent,
            cycles: 20_000,
        }
    }

    #[test]
    fn a_result_is_read_as_written_and_a_cut_line_is_left_out() {
        for (kind, exponent) in [
            (Kind::Periodic(12), None),
            (Kind::Chaos, Some([0.1 / 3.0, 1e-4])),
            (Kind::Torus, Some([-1e-7, 1e-3 / 3.0])),
            (Kind::Unsettled, Some([-0.1, 1e-3])),
            (Kind::Lost, None),
        ] {
            let written = ending(kind, exponent);
            let text = format!("key;{};", line(&written));
            let (key, read) = parsed(&text).unwrap();
            assert_eq!(key, "key");
            assert_eq!(format!("{read:?}"), format!("{written:?}"));
            assert!((0..text.len()).all(|length| parsed(&text[..length]).is_none()));
        }
    }
}
