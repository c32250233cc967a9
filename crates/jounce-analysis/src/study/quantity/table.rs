//! Entries of the table `[quantity]` of a study.

use crate::study::faults::FaultCollector;
use crate::{BranchSearch, Recognition};
use jounce_spec::{KeyRange, Quantity as Kind, SpecFile};
use toml_edit::{Item, Table};

/// The table `[quantity]`, and its spec.
pub(super) struct QuantityTable<'a> {
    pub table: &'a Table,
    pub file: &'a SpecFile,
}

impl QuantityTable<'_> {
    /// Reads a whole number from 1.
    pub fn integer(&self, reader: &mut FaultCollector, key: &str, most: u64, default: u64) -> u64 {
        reader.integer(
            &format!("quantity.{key}"),
            self.table.get(key),
            (1, most),
            default,
        )
    }

    /// Reads the number of values at which branches are sought.
    pub fn seeds(&self, reader: &mut FaultCollector, default: usize) -> usize {
        let item = self.table.get("seeds");
        let most = BranchSearch::MAX_SEEDS as u64;
        reader.integer("quantity.seeds", item, (0, most), default as u64) as usize
    }

    /// Reads a relative tolerance.
    pub fn tolerance(&self, reader: &mut FaultCollector, default: f64) -> f64 {
        reader.positive("quantity.tolerance", self.table.get("tolerance"), default)
    }

    /// Reads the options of the recognition of attractors.
    pub fn recognition(&self, reader: &mut FaultCollector) -> Recognition {
        let defaults = Recognition::at(self.tolerance(reader, 1e-8));
        let most = u64::from(u32::MAX);
        Recognition {
            longest_period: self.integer(
                reader,
                "longest_period",
                most,
                u64::from(defaults.longest_period),
            ) as u32,
            max_cycles: self.integer(reader, "max_cycles", most, u64::from(defaults.max_cycles))
                as u32,
            ..defaults
        }
    }

    /// Returns the position of an entry in the text.
    pub fn span(&self, key: &str) -> Option<std::ops::Range<usize>> {
        let item = self.table.get(key);
        item.and_then(Item::span).or(self.table.span())
    }

    /// Reads one word of a list, by default the first.
    pub fn one_of<T: Copy>(
        &self,
        reader: &mut FaultCollector,
        key: &str,
        known: &[(&str, T)],
    ) -> T {
        let path = format!("quantity.{key}");
        let text = reader.text(&path, self.table.get(key));
        let choice = text.map_or(known.first(), |text| {
            known.iter().find(|(word, _)| *word == text)
        });
        if choice.is_none() {
            let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
            let reason = format!(
                "{path} is \"{}\"; it must be one of {}",
                text.unwrap_or_default(),
                words.join(", ")
            );
            reader.fault(&path, self.span(key), reason);
        }
        choice.unwrap_or(&known[0]).1
    }

    /// Reads a frequency above 0, Hz.
    pub fn frequency(&self, reader: &mut FaultCollector, key: &str, default_hz: f64) -> f64 {
        let path = format!("quantity.{key}");
        let Some(text) = reader.text(&path, self.table.get(key)) else {
            return default_hz;
        };
        let read = Kind::Frequency
            .read(text)
            .map_err(|error| error.to_string());
        let frequency_hz = read.and_then(|value| {
            if value > 0.0 && value.is_finite() {
                Ok(value)
            } else {
                Err("it must be above 0 Hz".to_owned())
            }
        });
        frequency_hz.unwrap_or_else(|reason| {
            reader.fault(
                &path,
                self.span(key),
                format!("{path} is \"{text}\": {reason}"),
            );
            default_hz
        })
    }

    /// Reads a key and its values, with the text of the values.
    pub fn values<'t>(&'t self, reader: &mut FaultCollector) -> Option<(KeyRange, &'t str)> {
        let text = self.assignment(reader, "over", "drive.shaker.frequency=10Hz:14Hz:0.1Hz")?;
        match self.file.range(text) {
            Ok(range) => Some((range, text.split_once('=').map_or("", |(_, values)| values))),
            Err(faults) => {
                faults.as_slice().iter().for_each(|fault| {
                    reader.fault("quantity.over", self.span("over"), &fault.message)
                });
                None
            }
        }
    }

    /// Reads a key and the two ends of its range.
    pub fn ends(
        &self,
        reader: &mut FaultCollector,
        key: &str,
        example: &str,
    ) -> (String, (f64, f64)) {
        let path = format!("quantity.{key}");
        let nothing = (String::new(), (0.0, 1.0));
        let Some(text) = self.assignment(reader, key, example) else {
            return nothing;
        };
        match self.file.range(&text.replacen(':', ",", 1)) {
            Ok(range) => match range.values() {
                [low, high] if low < high => return (range.key().path().to_owned(), (*low, *high)),
                _ => reader.fault(
                    &path,
                    self.span(key),
                    format!("{text}: write KEY=FROM:TO, from a smaller to a larger value"),
                ),
            },
            Err(faults) => faults
                .as_slice()
                .iter()
                .for_each(|fault| reader.fault(&path, self.span(key), &fault.message)),
        }
        nothing
    }

    /// Reads `KEY=VALUES` as text; a missing one is a fault.
    fn assignment<'t>(
        &'t self,
        reader: &mut FaultCollector,
        key: &str,
        example: &str,
    ) -> Option<&'t str> {
        let path = format!("quantity.{key}");
        let item = self.table.get(key);
        if item.is_none() {
            reader.fault(
                &path,
                self.span(key),
                format!("{path} is missing; write {key} = \"{example}\""),
            );
        }
        reader.text(&path, item)
    }
}
