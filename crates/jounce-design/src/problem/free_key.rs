//! Free keys: ranges of numbers, and choices.

use jounce_spec::{Faults, KeyRange, NumericKey, Spec, SpecFile};
use toml_edit::DocumentMut;

/// A key that the search may set.
#[derive(Debug, Clone)]
pub struct FreeKey {
    /// Dotted path.
    pub path: String,
    /// Allowed values.
    pub values: FreeValues,
}

/// Allowed values of a free key.
#[derive(Debug, Clone)]
pub enum FreeValues {
    /// All numbers between two ends.
    Range(Box<FreeRange>),
    /// Some texts, such as names of materials.
    Choice(Vec<String>),
}

/// Numbers between two ends.
#[derive(Debug, Clone)]
pub struct FreeRange {
    /// The key.
    pub key: NumericKey,
    /// Smallest value, SI.
    pub low: f64,
    /// Largest value, SI.
    pub high: f64,
    /// True where the logarithm of the value is searched evenly.
    pub logarithmic: bool,
}

impl FreeRange {
    /// Returns the number at a place in [0, 1], SI.
    pub fn value(&self, place: f64) -> f64 {
        let value = match self.logarithmic {
            true => self.low * (self.high / self.low).powf(place),
            false => self.low + (self.high - self.low) * place,
        };
        let value = if self.key.is_count() {
            value.round()
        } else {
            value
        };
        value.clamp(self.low, self.high)
    }

    /// Returns the place of a number, SI.
    fn place(&self, value: f64) -> f64 {
        match self.logarithmic {
            true => (value / self.low).ln() / (self.high / self.low).ln(),
            false => (value - self.low) / (self.high - self.low),
        }
    }

    /// Returns the derivative of the number by the place.
    pub(crate) fn slope(&self, place: f64) -> f64 {
        match self.logarithmic {
            true => self.value(place) * (self.high / self.low).ln(),
            false => self.high - self.low,
        }
    }

    /// Returns a number, SI, as text with its unit.
    fn text(&self, value: f64) -> String {
        match self.key.is_count() {
            true => value.to_string(),
            false => format!("{value:?} {}", self.key.unit())
                .trim_end()
                .to_owned(),
        }
    }
}

impl FreeKey {
    /// Reads `FROM:TO` or `FROM:TO:log`, each with its unit or with one unit at the end.
    ///
    /// # Errors
    /// A message with the mistake and what is allowed.
    pub(super) fn range(file: &SpecFile, path: &str, text: &str) -> Result<Self, Vec<String>> {
        let key = file.numeric_key(path).map_err(|faults| messages(&faults))?;
        let wrong = || {
            vec![format!(
                "{path}: {text:?} is no range; write FROM:TO, or FROM:TO:log above 0, from a smaller to a larger value"
            )]
        };
        let logarithmic = text.contains(":log");
        let ends = text.replacen(":log", "", 1);
        let (from, to) = ends.split_once(':').ok_or_else(wrong)?;
        let unit = if from.trim().parse::<f64>().is_ok() {
            unit_of(to)
        } else {
            ""
        };
        let range = KeyRange::parse(key, &format!("{from} {unit},{to}"))
            .map_err(|fault| vec![fault.message])?;
        let [low, high] = range.values()[..] else {
            return Err(wrong());
        };
        if low >= high || (logarithmic && low <= 0.0) {
            return Err(wrong());
        }
        let range = FreeRange {
            key: range.key().clone(),
            low,
            high,
            logarithmic,
        };
        Ok(Self {
            path: path.to_owned(),
            values: FreeValues::Range(Box::new(range)),
        })
    }

    /// Returns the place of the value in a spec; `None` where the spec has another one than allowed.
    pub(crate) fn place(&self, spec: &Spec) -> Option<f64> {
        let place = match &self.values {
            FreeValues::Range(range) => range.place(range.key.get(spec).ok()?),
            FreeValues::Choice(texts) => {
                let given = text_at(spec, &self.path);
                let index = texts.iter().position(|text| *text == given)?;
                (index as f64 + 0.5) / texts.len() as f64
            }
        };
        (0.0..=1.0).contains(&place).then_some(place)
    }

    /// Returns the index of the choice at a place; 0 for a range.
    pub(crate) fn choice(&self, place: f64) -> usize {
        match &self.values {
            FreeValues::Choice(texts) => {
                ((place * texts.len() as f64) as usize).min(texts.len() - 1)
            }
            FreeValues::Range(_) => 0,
        }
    }

    /// Returns the range if results have a derivative by the key.
    pub(crate) fn smooth(&self) -> Option<&FreeRange> {
        match &self.values {
            FreeValues::Range(range) if !range.key.is_count() => Some(range),
            FreeValues::Range(_) | FreeValues::Choice(_) => None,
        }
    }

    /// Returns the value at a place as text with its unit, as `--set` takes it.
    pub fn text(&self, place: f64) -> String {
        match &self.values {
            FreeValues::Choice(texts) => texts[self.choice(place)].clone(),
            FreeValues::Range(range) => range.text(range.value(place)),
        }
    }

    /// Returns the value in a spec as text with its unit; empty where the spec has none.
    pub fn given(&self, spec: &Spec) -> String {
        match &self.values {
            FreeValues::Choice(_) => text_at(spec, &self.path),
            FreeValues::Range(range) => range
                .key
                .get(spec)
                .map_or_else(|_| String::new(), |value| range.text(value)),
        }
    }
}

/// Returns the text at a dotted path of a spec; empty without one.
fn text_at(spec: &Spec, path: &str) -> String {
    let Ok(document) = spec.to_toml().parse::<DocumentMut>() else {
        return String::new();
    };
    let mut item = document.as_item();
    for name in path.split('.') {
        match item.get(name) {
            Some(inner) => item = inner,
            None => return String::new(),
        }
    }
    item.as_str().unwrap_or_default().to_owned()
}

/// Returns the messages of faults.
pub(super) fn messages(faults: &Faults) -> Vec<String> {
    let all = faults.as_slice().iter();
    all.map(|fault| fault.message.clone()).collect()
}

/// Returns what follows the longest number at the start of a text.
fn unit_of(text: &str) -> &str {
    let number = (0..=text.len())
        .rev()
        .filter_map(|end| text.get(..end))
        .find(|number| number.trim().parse::<f64>().is_ok());
    text[number.map_or(0, str::len)..].trim()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    const SPEC: &str = "[modal.m]\nfrequency_hz = [10.0]\ndamping_ratio = [0.01]\n[modal.m.point]\ntip = [1.0]\n\
        [stop.s]\nat = \"m.tip\"\nlaw = \"hertz\"\ngap = \"1 mm\"\nstiffness = \"1000 N/m^1.5\"\n\
        [drive.d]\nat = \"m.tip\"\nkind = \"force\"\namplitude = \"1 N\"\nfrequency = \"9 Hz\"\n\
        [run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";

    #[test]
    fn a_range_has_units_at_its_ends_or_one_for_both() {
        let file = SpecFile::from_text(SPEC);
        let range = |path: &str, text: &str| FreeKey::range(&file, path, text).unwrap();
        let value = |free: &FreeKey, place: f64| free.smooth().unwrap().value(place);
        for text in ["0.2mm:3mm", "0.2 mm:3 mm"] {
            let gap = range("stop.s.gap", text);
            assert_eq!((value(&gap, 0.0), value(&gap, 1.0)), (0.2e-3, 3e-3));
            assert_eq!(gap.text(1.0), "0.003 m");
        }
        for text in ["100:1e5:log N/m^1.5", "100 N/m^1.5:1e5 N/m^1.5:log"] {
            let stiffness = range("stop.s.stiffness", text);
            assert!((value(&stiffness, 0.5) / 1e3_f64.powf(0.5) / 100.0 - 1.0).abs() < 1e-12);
            let place = stiffness.place(&file.spec().unwrap()).unwrap();
            assert!((value(&stiffness, place) / 1000.0 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn empty_and_reversed_ranges_are_refused() {
        let file = SpecFile::from_text(SPEC);
        for text in [
            "3mm:1mm",
            "1mm:1mm",
            "1mm",
            "0mm:1mm:log",
            "1mm:2mm:5x",
            "a:b",
        ] {
            let faults = FreeKey::range(&file, "stop.s.gap", text).unwrap_err();
            assert!(faults[0].contains("stop.s.gap"), "{text}: {faults:?}");
        }
    }
}
