//! Counts of the verdicts on a range of harvesters.

use super::system::drawn;
use super::verdict::{Verdict, compare};
use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::time::Instant;

/// Largest number of harvesters shown with their differences.
const SHOWN: usize = 100;

/// Counts of verdicts.
#[derive(Default)]
pub struct Tally {
    first: u64,
    count: u64,
    pub agree: u64,
    grazing: u64,
    sensitive: u64,
    limit: u64,
    duration: u64,
    refused: BTreeMap<String, u64>,
    pub disagree: Vec<(u64, String)>,
    contacts: u64,
    peaks: u64,
    settled: u64,
    /// Largest ratio of a difference to its bound among those that agree.
    ratio: f64,
    /// Largest residual of the energy balance among those, in tolerances of the largest energy.
    residual: f64,
    /// Largest relative difference of the time in contact among those and those where only it differs.
    longest: f64,
    /// Wall time in all, of one run by brute force, and of the library, s.
    seconds: [f64; 3],
}

impl Tally {
    /// Compares harvesters `first` to `first + count`.
    pub fn of(first: u64, count: u64) -> Self {
        let begin = Instant::now();
        let mut tally = Self {
            first,
            count,
            ..Self::default()
        };
        for index in first..first + count {
            tally.add(index);
        }
        tally.seconds[0] = begin.elapsed().as_secs_f64();
        tally
    }

    fn add(&mut self, index: u64) {
        let drawn = match drawn(index) {
            Ok(drawn) => drawn,
            Err(reason) => return self.refuse(&reason),
        };
        let comparison = compare(&drawn);
        self.seconds[1] += comparison.seconds[0];
        self.seconds[2] += comparison.seconds[1];
        self.contacts += comparison.contacts as u64;
        self.peaks += u64::from(comparison.peak);
        if matches!(comparison.verdict, Verdict::Agree | Verdict::Duration) {
            self.longest = self.longest.max(comparison.duration);
        }
        match comparison.verdict {
            Verdict::Agree => {
                self.agree += 1;
                self.settled += u64::from(comparison.settled);
                self.ratio = self.ratio.max(comparison.ratio);
                self.residual = self.residual.max(comparison.residual);
            }
            Verdict::Grazing => self.grazing += 1,
            Verdict::Sensitive => self.sensitive += 1,
            Verdict::Limit => self.limit += 1,
            Verdict::Duration => self.duration += 1,
            Verdict::Refused(reason) => self.refuse(&reason),
            Verdict::Disagree(message) => self.disagree.push((index, message)),
        }
    }

    /// Counts a refusal by its words without the numbers.
    fn refuse(&mut self, reason: &str) {
        let words = reason.split_whitespace();
        let words: Vec<&str> = words
            .filter(|word| !word.contains(|c: char| c.is_ascii_digit()))
            .collect();
        *self.refused.entry(words.join(" ")).or_default() += 1;
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let refused: u64 = self.refused.values().sum();
        write!(
            f,
            "first {} count {} agree {} grazing {} sensitive {} limit {} duration {} refused {refused} disagree {} contacts {} peaks {} settled {} ratio {:.2e} residual {:.1} longest {:.1e} seconds {:.1?}",
            self.first,
            self.count,
            self.agree,
            self.grazing,
            self.sensitive,
            self.limit,
            self.duration,
            self.disagree.len(),
            self.contacts,
            self.peaks,
            self.settled,
            self.ratio,
            self.residual,
            self.longest,
            self.seconds
        )?;
        for (reason, count) in &self.refused {
            write!(f, "\n  refused {count}: {reason}")?;
        }
        for (index, message) in self.disagree.iter().take(SHOWN) {
            write!(f, "\n  disagree {index}: {message}")?;
        }
        Ok(())
    }
}
