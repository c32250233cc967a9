//! Design: the spec file with the overrides of a page.

use crate::source::Source;
use jounce_core::spec::{Fault, NumericKey, Spec, SpecFile};
use serde_json::{Value, json};
use std::path::Path;

/// Largest ratio of a change to the previous one for which that is extrapolated.
const MAX_CHANGE_RATIO: f64 = 4.0;

/// Design without faults.
pub struct Design {
    /// The file with its overrides.
    pub file: SpecFile,
    /// Spec of the file with the overrides.
    pub spec: Spec,
    /// Overridden keys.
    pub overridden_keys: Vec<String>,
}

/// Fault of a design.
#[derive(Debug, Clone, PartialEq)]
pub enum DesignFault {
    /// Faults by key, with the messages of the command line.
    Faults(Vec<Fault>),
    /// Fault of the entire design.
    Text(String),
}

impl<E: std::error::Error> From<E> for DesignFault {
    fn from(error: E) -> Self {
        DesignFault::Text(error.to_string())
    }
}

impl DesignFault {
    /// Returns the faults for the page: key, line, message.
    pub fn fault_list(&self, path: &Path) -> Value {
        let message = |fault: &Fault| match fault.set {
            Some(_) => fault.to_string(),
            None if fault.line == 0 => fault.message.clone(),
            None => format!("{}:{fault}", path.display()),
        };
        match self {
            DesignFault::Text(text) => json!([{ "key": "", "line": 0, "message": text }]),
            DesignFault::Faults(faults) => {
                let entry = |fault: &Fault| {
                    let set = fault
                        .set
                        .as_ref()
                        .and_then(|set| set.strip_prefix("--set ")?.split_once('='));
                    let key = set.map_or(fault.key.as_str(), |(key, _)| key);
                    json!({ "key": key, "line": fault.line, "message": message(fault) })
                };
                faults.iter().map(entry).collect()
            }
        }
    }
}

impl Design {
    /// Reads the spec and applies overrides of numbers.
    ///
    /// # Errors
    /// [`DesignFault`]: the file cannot be read, has faults, or an override is not a number or has
    /// a value out of range.
    pub fn read(source: &Source, set: &[(String, String)]) -> Result<Self, DesignFault> {
        let mut file = source.read()?;
        if !set.is_empty() {
            // A page may change numbers only, never the path of a file.
            let base = file
                .spec()
                .map_err(|faults| DesignFault::Faults(faults.as_slice().to_vec()))?;
            let mut faults = Vec::new();
            for (key, value) in set {
                let result = NumericKey::find(&base, key).and_then(|_| file.set(key, value));
                faults.extend(result.err());
            }
            if !faults.is_empty() {
                return Err(DesignFault::Faults(faults));
            }
        }
        let spec = file
            .spec()
            .map_err(|faults| DesignFault::Faults(faults.as_slice().to_vec()))?;
        Ok(Self {
            file,
            spec,
            overridden_keys: set.iter().map(|(key, _)| key.clone()).collect(),
        })
    }

    /// Returns a numeric key.
    ///
    /// # Errors
    /// [`DesignFault::Faults`] for an unknown key.
    pub fn key(&self, path: &str) -> Result<NumericKey, DesignFault> {
        self.file
            .numeric_key(path)
            .map_err(|faults| DesignFault::Faults(faults.as_slice().to_vec()))
    }

    /// Returns the change from the last spec to this design, as a multiple of the change before;
    /// `None` where the two have different directions.
    pub fn change_ratio(&self, previous: &Spec, last: &Spec) -> Option<f64> {
        let (mut dot, mut first_norm2, mut second_norm2) = (0.0, 0.0, 0.0);
        for path in &self.overridden_keys {
            let key = NumericKey::find(&self.spec, path).ok()?;
            let [a, b, c] = [previous, last, &self.spec].map(|spec| key.get(spec));
            let (a, b, c) = (a.ok()?, b.ok()?, c.ok()?);
            let size = b.abs().max(f64::MIN_POSITIVE);
            let (first, second) = ((b - a) / size, (c - b) / size);
            (dot, first_norm2, second_norm2) = (
                dot + first * second,
                first_norm2 + first * first,
                second_norm2 + second * second,
            );
        }
        let ratio = dot / first_norm2;
        // Where two keys change, each must change in proportion.
        let off_direction = second_norm2 - ratio * dot > 0.01 * second_norm2;
        (first_norm2 > 0.0 && ratio.abs() < MAX_CHANGE_RATIO && !off_direction).then_some(ratio)
    }

    /// Returns a key after a check that both ends of its range are allowed.
    ///
    /// # Errors
    /// [`DesignFault`] as on the command line.
    pub fn range(&self, path: &str, from: f64, to: f64) -> Result<NumericKey, DesignFault> {
        let key = self.key(path)?;
        if !(from < to && from.is_finite() && to.is_finite()) {
            return Err(DesignFault::Text(format!(
                "{path}: the range must go from a smaller to a larger value"
            )));
        }
        for value in [from, to] {
            key.set(&mut self.spec.clone(), value)
                .map_err(|fault| DesignFault::Faults(vec![fault]))?;
        }
        Ok(key)
    }
}
