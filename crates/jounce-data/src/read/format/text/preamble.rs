//! Instrument settings above the rows, or next to them: rate, start, names and units.
//!
//! A value is in the field after its key, after `:` or `=`, or below it in a line of values.

use super::settings_keys::{
    NAME_KEYS, RATE_KEYS, START_KEYS, STEP_KEYS, TIME_UNIT_KEYS, UNIT_KEYS, key,
};
use crate::read::column::raw::Rate;
use crate::recording::{Issue, IssueKind, Quantity, Unit};

/// Instrument settings above the rows of a text, or next to them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::read) struct Preamble {
    /// Rate, with its text.
    pub rate: Option<Rate>,
    /// Time of the first sample, s.
    pub start: Option<f64>,
    /// Units of the channels: one for each, or one for all.
    pub units: Vec<String>,
    /// Unit of the time.
    pub time_unit: Option<String>,
    /// Names of the channels.
    pub names: Vec<String>,
    /// Contradictions.
    pub issues: Vec<Issue>,
}

impl Preamble {
    /// Parses lines of fields.
    pub(super) fn read(lines: &[Vec<String>]) -> Self {
        let mut preamble = Self::default();
        let (mut steps, mut rates) = (Vec::new(), Vec::new());
        for (k, fields) in lines.iter().enumerate() {
            for (j, field) in fields.iter().enumerate() {
                let (name, other_fields) = match field
                    .split_once(['=', ':'])
                    .filter(|(_, value)| !value.trim().is_empty())
                {
                    Some((name, value)) => (name, vec![value.to_owned()]),
                    None if j == 0 => (field.as_str(), fields[1..].to_vec()),
                    None => (field.as_str(), Vec::new()),
                };
                let field_below = lines
                    .get(k + 1)
                    .and_then(|field_below| field_below.get(j))
                    .filter(|_| other_fields.is_empty())
                    .cloned();
                let values: Vec<String> = other_fields.into_iter().chain(field_below).collect();
                preamble.apply(name, &values, &mut steps, &mut rates);
            }
        }
        preamble.rate = steps.first().or(rates.first()).cloned();
        let Some(first) = &preamble.rate else {
            return preamble;
        };
        let other = steps
            .iter()
            .chain(&rates)
            .find(|other| other.differs_from(first.rate_hz));
        preamble.issues.extend(other.map(|other| {
            let message = format!(
                "{} is a rate of {} Hz, {} one of {} Hz; the first is used",
                first.source, first.rate_hz, other.source, other.rate_hz
            );
            Issue::new(IssueKind::HeaderDisagrees, 1, None, message)
        }));
        preamble
    }

    fn apply(
        &mut self,
        name: &str,
        values: &[String],
        steps: &mut Vec<Rate>,
        rates: &mut Vec<Rate>,
    ) {
        let (word, unit) = key(name);
        let word = word.as_str();
        let source = |value: f64| {
            format!(
                "{} = {value}",
                name.trim().trim_matches(['"', '#', ':']).trim()
            )
        };
        if STEP_KEYS.contains(&word) {
            let step = number(values, &unit)
                .and_then(|(number, unit)| Some((number, number * time_factor(&unit)?)));
            let valid = step.filter(|(_, step)| *step > 0.0 && step.is_finite());
            steps.extend(valid.map(|(number, step)| Rate {
                source: source(number),
                rate_hz: 1.0 / step,
            }));
        } else if RATE_KEYS.contains(&word) {
            let rate = number(values, &unit)
                .and_then(|(number, unit)| Some((number, number * rate_factor(&unit)?)));
            let valid = rate.filter(|(_, rate_hz)| *rate_hz > 0.0 && rate_hz.is_finite());
            rates.extend(valid.map(|(number, rate_hz)| Rate {
                source: source(number),
                rate_hz,
            }));
        } else if START_KEYS.contains(&word) && (self.start.is_none() || !word.starts_with("start"))
        {
            // `Start` may be the index of a point if an origin is also given.
            let start =
                number(values, &unit).and_then(|(number, unit)| Some(number * time_factor(&unit)?));
            self.start = start.filter(|start| start.is_finite()).or(self.start);
        } else if UNIT_KEYS.contains(&word) && self.units.is_empty() {
            self.units = listed_words(values);
        } else if TIME_UNIT_KEYS.contains(&word) {
            let normalised = |text: &String| {
                text.strip_suffix('S')
                    .map_or_else(|| text.clone(), |prefix| format!("{prefix}s"))
            };
            self.time_unit = listed_words(values)
                .first()
                .map(normalised)
                .filter(|unit| time_factor(unit).is_some());
        } else if NAME_KEYS.contains(&word) && self.names.is_empty() {
            self.names = listed_words(values);
        }
    }
}

/// Splits values of a list: `V,V`, `CH1:V CH2:V`, `V`.
fn listed_words(values: &[String]) -> Vec<String> {
    let words = values.iter().flat_map(|value| value.split_whitespace());
    let stripped = words.map(|word| {
        word.rsplit(':')
            .next()
            .unwrap_or_default()
            .trim_matches(['"', '(', ')', '[', ']'])
            .to_owned()
    });
    stripped.filter(|word| !word.is_empty()).collect()
}

/// First number of values, as in `2.0e-6`, `1 kHz`, `CH1:2e-6 CH2:2e-6`. Its unit is after it, in
/// the next field, or that of the key.
fn number(values: &[String], unit: &str) -> Option<(f64, String)> {
    let value = values.first()?.trim().trim_matches('"');
    let value = if value.contains(':') {
        value.split_whitespace().next()?.rsplit(':').next()?
    } else {
        value
    };
    let prefixes = (1..=value.len())
        .rev()
        .filter(|end| value.is_char_boundary(*end));
    let (number, rest) = prefixes
        .map(|end| value.split_at(end))
        .find_map(|(text, rest)| Some((text.trim().parse::<f64>().ok()?, rest.trim())))?;
    let next = values
        .get(1)
        .map(|next| next.trim().trim_matches('"'))
        .filter(|next| next.starts_with(char::is_alphabetic));
    let unit_text = [rest, next.unwrap_or_default(), unit]
        .into_iter()
        .find(|text| !text.is_empty())
        .unwrap_or_default();
    Some((number, unit_text.to_owned()))
}

/// Seconds per unit of time; `s` if no unit is given.
fn time_factor(unit: &str) -> Option<f64> {
    if unit.is_empty() {
        return Some(1.0);
    }
    // Seconds may be written `S`.
    let normalised = unit.strip_suffix('S').map(|prefix| format!("{prefix}s"));
    let read = |unit: &str| {
        Unit::read(unit)
            .filter(|unit| unit.quantity == Quantity::Time)
            .map(|unit| unit.factor)
    };
    read(unit).or_else(|| read(&normalised?))
}

/// Hertz per unit of rate: `Hz`, `kHz`, `Sa/s`, `MS/s`, `samples/s`; Hz if no unit is given.
fn rate_factor(unit: &str) -> Option<f64> {
    let rate_units = [
        "samples/s",
        "Samples/s",
        "Sa/s",
        "sa/s",
        "S/s",
        "Sps",
        "SPS",
        "sps",
        "1/s",
        "Hz",
        "hz",
    ];
    let prefix = rate_units
        .iter()
        .find_map(|suffix| unit.strip_suffix(suffix))
        .or(unit.is_empty().then_some(""))?;
    match prefix.trim() {
        "" => Some(1.0),
        "k" | "K" => Some(1e3),
        "M" => Some(1e6),
        "G" => Some(1e9),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::settings_keys::is_pair;
    use super::*;

    fn read(text: &str) -> Preamble {
        let lines: Vec<Vec<String>> = text
            .lines()
            .map(|line| line.split(',').map(str::to_owned).collect())
            .collect();
        Preamble::read(&lines)
    }

    #[test]
    fn steps_rates_and_starts_of_every_spelling_are_read() {
        let cases = [
            (
                "X,CH1,Start,Increment,\nSequence,Volt,-7.0e-02,1.0e-04,",
                1e4,
                Some(-0.07),
            ),
            ("Time(s),CH1V,t0 =-5e-05, tInc = 1e-06,", 1e6, Some(-5e-5)),
            ("\"Sample Interval\",2e-05,s,-0.5,1.2", 5e4, None),
            ("Sample Interval,CH1:0.0002 CH2:0.0002", 5e3, None),
            ("Sample Interval,Analog:1.0E-09", 1e9, None),
            ("Sampling Period,2.000e-06,", 5e5, None),
            ("XInc:,5e-11\nXOrg:,-2.5e-7", 2e10, Some(-2.5e-7)),
            ("Start:,0\nXInc:,5e-11\nXOrg:,-2.5e-7", 2e10, Some(-2.5e-7)),
            ("; Samplerate: 1 kHz", 1e3, None),
            ("# Sampling rate = 25.6 kS/s", 25_600.0, None),
            ("Sample Rate(Hz),2048", 2048.0, None),
            ("Interval,1 ms", 1e3, None),
            ("Delta_X\t1", f64::NAN, None),
        ];
        for (text, rate_hz, start) in cases {
            let result = read(text);
            match result.rate {
                Some(rate) => assert!(
                    (rate.rate_hz / rate_hz - 1.0).abs() < 1e-12,
                    "{text}: {}",
                    rate.rate_hz
                ),
                None => assert!(rate_hz.is_nan(), "{text}"),
            }
            assert_eq!(result.start, start, "{text}");
        }
        for text in [
            "Sample Interval,0",
            "Sample Interval,-1",
            "Sample Interval,soon",
            "Sample Rate,5 furlong",
            "rate,channel",
            "Time Scale,0.5",
        ] {
            assert_eq!(read(text).rate, None, "{text}");
        }
        assert_eq!(
            read("Sample Rate,1000\nSample Interval,0.002").issues.len(),
            1
        );
    }

    #[test]
    fn units_and_names_are_listed() {
        let result = read("Vertical Units,CH1:V CH2:mV\nHorizontal Units,S\nSource,CH1,CH2");
        assert_eq!(
            (result.units, result.time_unit.as_deref(), result.names),
            (
                vec!["V".into(), "mV".into()],
                Some("s"),
                vec!["CH1".into(), "CH2".into()]
            )
        );
        assert!(
            is_pair(&["Time".into(), "12-Mar-2020 14:25:31".into()])
                && !is_pair(&["Time".into(), "Ampl".into()])
                && !is_pair(&["CH1".into(), "CH2".into()])
        );
    }
}
