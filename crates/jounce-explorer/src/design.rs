//! The spec file with the overrides of a page.

use crate::source::Source;
use jounce::spec::{Fault, NumericKey, Spec, SpecFile};
use serde_json::{Value, json};
use std::path::Path;

/// A change more than so many times the one before says nothing from it.
const MAX_CHANGE_RATIO: f64 = 4.0;

/// A design without faults.
pub struct Design {
    /// The file with its overrides.
    pub file: SpecFile,
    /// The spec that both give.
    pub spec: Spec,
    /// The keys that are overridden.
    pub overridden: Vec<String>,
}

/// What is wrong with a design.
#[derive(Debug, Clone, PartialEq)]
pub enum DesignFault {
    /// By key, in the words of the command line.
    Faults(Vec<Fault>),
    /// As a whole.
    Text(String),
}

impl<E: std::error::Error> From<E> for DesignFault {
    fn from(error: E) -> Self {
        DesignFault::Text(error.to_string())
    }
}

impl DesignFault {
    /// A list of faults for the page: key, place, words.
    pub fn listed(&self, path: &Path) -> Value {
        let words = |fault: &Fault| match fault.set {
            Some(_) => fault.to_string(),
            None if fault.line == 0 => fault.message.clone(),
            None => format!("{}:{fault}", path.display()),
        };
        match self {
            DesignFault::Text(text) => json!([{ "key": "", "line": 0, "message": text }]),
            DesignFault::Faults(faults) => {
                let listed = |fault: &Fault| {
                    let set = fault
                        .set
                        .as_ref()
                        .and_then(|set| set.strip_prefix("--set ")?.split_once('='));
                    let key = set.map_or(fault.key.as_str(), |(key, _)| key);
                    json!({ "key": key, "line": fault.line, "message": words(fault) })
                };
                faults.iter().map(listed).collect()
            }
        }
    }
}

impl Design {
    /// Reads the spec as it is now and applies overrides of numbers.
    ///
    /// # Errors
    /// [`DesignFault`]: a file that cannot be read, faults in it, an override of something that is no number, a value that is not allowed.
    pub fn read(source: &Source, set: &[(String, String)]) -> Result<Self, DesignFault> {
        let mut file = source.read()?;
        if !set.is_empty() {
            // A page may change numbers only: no path of a file comes from it.
            let base = file
                .spec()
                .map_err(|faults| DesignFault::Faults(faults.as_slice().to_vec()))?;
            let mut faults = Vec::new();
            for (key, value) in set {
                let put = NumericKey::find(&base, key).and_then(|_| file.set(key, value));
                faults.extend(put.err());
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
            overridden: set.iter().map(|(key, _)| key.clone()).collect(),
        })
    }

    /// A key with a number.
    ///
    /// # Errors
    /// [`DesignFault::Faults`] for a key that is none.
    pub fn key(&self, path: &str) -> Result<NumericKey, DesignFault> {
        self.file
            .numeric_key(path)
            .map_err(|faults| DesignFault::Faults(faults.as_slice().to_vec()))
    }

    /// The change from one spec to this design, in units of the change that led to that spec; nothing where the two changes are of
    /// different kinds.
    pub fn reach(&self, before: &Spec, last: &Spec) -> Option<f64> {
        let (mut along, mut square, mut all) = (0.0, 0.0, 0.0);
        for path in &self.overridden {
            let key = NumericKey::find(&self.spec, path).ok()?;
            let [a, b, c] = [before, last, &self.spec].map(|spec| key.get(spec));
            let (a, b, c) = (a.ok()?, b.ok()?, c.ok()?);
            let size = b.abs().max(f64::MIN_POSITIVE);
            let (first, second) = ((b - a) / size, (c - b) / size);
            (along, square, all) = (
                along + first * second,
                square + first * first,
                all + second * second,
            );
        }
        let reach = along / square;
        // Of two keys that move, each must go on as it went.
        let strays = all - reach * along > 0.01 * all;
        (square > 0.0 && reach.abs() < MAX_CHANGE_RATIO && !strays).then_some(reach)
    }

    /// A key and its range, both ends allowed.
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
