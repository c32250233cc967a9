//! Ranges of free numbers.

use super::free_key::messages;
use jounce_spec::{KeyRange, NumericKey, SpecFile};

/// Significant digits of the number of a design: finer than a workshop and the model, short enough to
/// read.
const DIGITS: usize = 6;

/// Decimals with which every number is exact.
const MOST_DECIMALS: usize = 16;

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
    /// Units of both ends as written, the smaller unit first; empty for plain numbers.
    units: [String; 2],
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
        let (low, high) = KeyRange::ends(&key, &from, &to).map_err(|fault| vec![fault.message])?;
        if low >= high || (logarithmic && low <= 0.0) {
            return Err(wrong());
        }
        let mut units = [&from, &to].map(|end| unit_of(end).to_owned());
        let size = |unit: &String| key.size_of(unit).unwrap_or(1.0);
        if size(&units[0]) > size(&units[1]) {
            units.reverse();
        }
        Ok(Self {
            key,
            low,
            high,
            logarithmic,
            units,
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
            false => {
                let text = self.written(value, DIGITS - 1);
                self.key.read(&text).unwrap_or(value)
            }
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

    /// Returns a number, SI, as text in a unit of the range with the fewest digits that give the number
    /// again; where no digits do, in the SI unit.
    pub(super) fn text(&self, value: f64) -> String {
        if self.key.is_count() {
            return value.to_string();
        }
        let in_unit = (0..=MOST_DECIMALS).map(|decimals| self.written(value, decimals));
        let mut exact = in_unit.filter(|text| self.key.read(text) == Ok(value));
        exact.next().unwrap_or_else(|| {
            let text = format!("{value:?} {}", self.key.unit());
            text.trim_end().to_owned()
        })
    }

    /// Returns a number, SI, with one digit before the decimal point and some after it, as text in the
    /// larger unit of the range of which it is at least one, else in the smaller one.
    fn written(&self, value: f64, decimals: usize) -> String {
        let sizes = (self.units.each_ref()).map(|unit| self.key.size_of(unit).unwrap_or(1.0));
        let larger = usize::from(value.abs() >= sizes[1]);
        let rounded = format!("{:.decimals$e}", value / sizes[larger]);
        let number = rounded.parse().unwrap_or(value / sizes[larger]);
        let unit = &self.units[larger];
        let number = format!("{number:?}");
        let number = number.strip_suffix(".0").unwrap_or(&number);
        format!("{number} {unit}").trim_end().to_owned()
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
            assert_eq!(gap.text(gap.value(1.0)), "3 mm");
            assert_eq!(gap.text(1e-3), "1 mm");
        }
        let load = range("drive.d.amplitude", "20mN:5N:log");
        let texts = [0.02, 0.1234567890123, 1.0, 2.5].map(|value| load.text(value));
        assert_eq!(texts, ["20 mN", "123.4567890123 mN", "1 N", "2.5 N"]);
        // A factor that is no power of ten.
        let speed = range("drive.d.frequency", "60rpm:1000rpm");
        assert_eq!(speed.text(speed.value(0.123456789)), "176.049 rpm");
        for place in [0.0, 0.1, 0.77, 1.0] {
            let value = speed.value(place);
            assert_eq!(speed.key.read(&speed.text(value)), Ok(value));
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
