//! Ranges of free numbers.

use super::free_key::messages;
use jounce_spec::{KeyRange, NumericKey, SpecFile};

/// Significant digits of the number of a design: finer than a workshop and the model, short enough to
/// read.
const DIGITS: usize = 6;

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
    /// Reads `FROM:TO` or `FROM:TO:log`, each with its unit or with one unit at the end.
    ///
    /// # Errors
    /// A message with the mistake and what is allowed.
    pub(super) fn read(file: &SpecFile, path: &str, text: &str) -> Result<Self, Vec<String>> {
        let key = file.numeric_key(path).map_err(|faults| messages(&faults))?;
        let wrong = || {
            vec![format!(
                "{path}: {text:?} is no range; write FROM:TO, or FROM:TO:log above 0, from a smaller to a larger value"
            )]
        };
        let (from, to, logarithmic) = ends(text).ok_or_else(wrong)?;
        let range =
            KeyRange::parse(key, &format!("{from},{to}")).map_err(|fault| vec![fault.message])?;
        let [low, high] = range.values()[..] else {
            return Err(wrong());
        };
        if low >= high || (logarithmic && low <= 0.0) {
            return Err(wrong());
        }
        Ok(Self {
            key: range.key().clone(),
            low,
            high,
            logarithmic,
        })
    }

    /// Returns the text of the smaller end of a range with its unit; `None` for another text.
    pub(super) fn first_end(text: &str) -> Option<String> {
        let (from, ..) = ends(text)?;
        let begins_a_number = |c: char| c.is_ascii_digit() || "+-.".contains(c);
        from.starts_with(begins_a_number).then_some(from)
    }

    /// Returns the smaller end as text with its unit.
    pub(super) fn low_text(&self) -> String {
        self.text(self.low)
    }

    /// Returns the number of a design at a place in [0, 1], SI: the rounded number of that place.
    pub fn value(&self, place: f64) -> f64 {
        let value = self.at(place);
        let rounded = match self.key.is_count() {
            true => value.round(),
            false => format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value),
        };
        rounded.clamp(self.low, self.high)
    }

    /// Returns the number at a place in [0, 1], SI, for searches that need a smooth function.
    pub(crate) fn at(&self, place: f64) -> f64 {
        let value = match self.logarithmic {
            true => self.low * (self.high / self.low).powf(place),
            false => self.low + (self.high - self.low) * place,
        };
        value.clamp(self.low, self.high)
    }

    /// Returns the place of a number, SI.
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.logarithmic {
            true => (value / self.low).ln() / (self.high / self.low).ln(),
            false => (value - self.low) / (self.high - self.low),
        }
    }

    /// Returns the derivative of the number by the place.
    pub(crate) fn slope(&self, place: f64) -> f64 {
        match self.logarithmic {
            true => self.at(place) * (self.high / self.low).ln(),
            false => self.high - self.low,
        }
    }

    /// Returns a number, SI, as text with its unit.
    pub(super) fn text(&self, value: f64) -> String {
        match self.key.is_count() {
            true => value.to_string(),
            false => format!("{value:?} {}", self.key.unit())
                .trim_end()
                .to_owned(),
        }
    }
}

/// Returns both ends of the text of a range with their units, and whether it is logarithmic.
fn ends(text: &str) -> Option<(String, String, bool)> {
    let logarithmic = text.contains(":log");
    let ends = text.replacen(":log", "", 1);
    let (from, to) = ends.split_once(':')?;
    if from.contains(',') || to.contains([',', ':']) {
        return None;
    }
    let unit = if from.trim().parse::<f64>().is_ok() {
        unit_of(to)
    } else {
        ""
    };
    let from = format!("{from} {unit}").trim().to_owned();
    Some((from, to.to_owned(), logarithmic))
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
        let range = |path: &str, text: &str| FreeRange::read(&file, path, text).unwrap();
        for text in ["0.2mm:3mm", "0.2 mm:3 mm"] {
            let gap = range("stop.s.gap", text);
            assert_eq!((gap.value(0.0), gap.value(1.0)), (0.2e-3, 3e-3));
            assert_eq!(gap.text(gap.value(1.0)), "0.003 m");
        }
        for text in ["100:1e5:log N/m^1.5", "100 N/m^1.5:1e5 N/m^1.5:log"] {
            let stiffness = range("stop.s.stiffness", text);
            assert!((stiffness.at(0.5) / 1e3_f64.powf(0.5) / 100.0 - 1.0).abs() < 1e-12);
            assert_eq!(stiffness.text(stiffness.value(0.5)), "3162.28 N/m^1.5");
            let place = stiffness.place(1000.0);
            assert!((stiffness.at(place) / 1000.0 - 1.0).abs() < 1e-12);
            assert_eq!(stiffness.value(place), 1000.0);
        }
    }

    #[test]
    fn a_rounded_number_stays_within_its_range() {
        let file = SpecFile::from_text(SPEC);
        let gap = FreeRange::read(&file, "stop.s.gap", "1.23456789mm:1.23456799mm").unwrap();
        for place in [0.0, 0.3, 0.7, 1.0] {
            assert!((gap.low..=gap.high).contains(&gap.value(place)));
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
            "1mm,2mm",
            "1mm,2mm:3mm",
            "a:b",
        ] {
            let faults = FreeRange::read(&file, "stop.s.gap", text).unwrap_err();
            let message = &faults[0];
            assert!(message.contains("stop.s.gap"), "{text}: {message}");
            if text.contains([',', 'x']) {
                let expected = format!("{text:?} is no range; write FROM:TO, or FROM:TO:log");
                assert!(message.contains(&expected), "{message}");
            }
        }
    }
}
