//! Dates and times of day in the notations of data loggers.
//!
//! | written | read as |
//! |---|---|
//! | `2024-03-05T14:07:01.25`, `2024/03/05 14:07:01,25`, optionally with `Z` or `+01:00` | a moment |
//! | `05.03.2024 14:07:01.25` | a moment, the day before the month |
//! | `03/05/2024 2:07:01.25 PM`, `05-Mar-2024 14:07:01` | the time of day only, because the order of day and month is ambiguous |
//! | `14:07:01.25`, `14:07:01:250` | a time of day |
//! | `07:01.25` | minutes and seconds |
//!
//! A date without a time means the beginning of the day.

use chrono::NaiveDate;

/// Nanoseconds of a second, and of a day.
const SECOND: i64 = 1_000_000_000;
const DAY: i64 = 86_400 * SECOND;

/// A point in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::read) struct Moment {
    /// Since 1970 if dated, else since midnight, ns.
    pub nanoseconds: i64,
    /// True where the date is known.
    pub dated: bool,
}

/// Converts consecutive moments of a column to seconds since the first one.
#[derive(Debug, Clone, Copy)]
pub(in crate::read) struct Clock {
    first: i64,
    previous: i64,
    days: i64,
}

impl Clock {
    /// Starts with a first moment.
    pub(in crate::read) fn from(first: Moment) -> Self {
        Self {
            first: first.nanoseconds,
            previous: first.nanoseconds,
            days: 0,
        }
    }

    /// Returns the seconds since the first moment. A time of day that drops by more than half a day
    /// belongs to the next day.
    pub(in crate::read) fn seconds(&mut self, moment: Moment) -> f64 {
        if !moment.dated && self.previous.saturating_sub(moment.nanoseconds) > DAY / 2 {
            self.days += 1;
        }
        self.previous = moment.nanoseconds;
        let elapsed = moment
            .nanoseconds
            .saturating_sub(self.first)
            .saturating_add(self.days.saturating_mul(DAY));
        // Separate whole seconds from the remainder to preserve the digits of long records.
        (elapsed / SECOND) as f64 + (elapsed % SECOND) as f64 / SECOND as f64
    }
}

impl Moment {
    /// Parses a moment; `None` for other text.
    pub(in crate::read) fn read(text: &str) -> Option<Self> {
        if !text.starts_with(|c: char| c.is_ascii_digit()) || text.len() > 48 || !text.is_ascii() {
            return None;
        }
        let clock_at = text.find(':');
        // The date ends at the last space or `T` before the first colon.
        let split = clock_at.and_then(|at| text[..at].rfind(['T', ' ', '_']));
        match (clock_at, split) {
            (None, _) => date(text)?.map(|days| Self {
                nanoseconds: days,
                dated: true,
            }),
            (Some(_), None) => Some(Self {
                nanoseconds: time(text)?,
                dated: false,
            }),
            (Some(_), Some(at)) => {
                let (day, time_of_day) = (date(text[..at].trim())?, time(text[at + 1..].trim())?);
                let nanoseconds =
                    day.map_or(Some(time_of_day), |day| day.checked_add(time_of_day))?;
                Some(Self {
                    nanoseconds,
                    dated: day.is_some(),
                })
            }
        }
    }
}

impl std::fmt::Display for Moment {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (day, time_of_day) = (
            self.nanoseconds.div_euclid(DAY),
            self.nanoseconds.rem_euclid(DAY),
        );
        let date = self
            .dated
            .then(|| NaiveDate::default().checked_add_signed(chrono::TimeDelta::days(day)))
            .flatten();
        if let Some(date) = date {
            write!(to, "{date} ")?;
        }
        let (seconds, fraction_ns) = (time_of_day / SECOND, time_of_day % SECOND);
        write!(
            to,
            "{:02}:{:02}:{:02}",
            seconds / 3600,
            seconds / 60 % 60,
            seconds % 60
        )?;
        let fraction = format!("{fraction_ns:09}");
        let fraction = fraction.trim_end_matches('0');
        if fraction.is_empty() {
            Ok(())
        } else {
            write!(to, ".{fraction}")
        }
    }
}

/// Beginning of a day since 1970, ns; the inner value is `None` where the order of day and month is
/// ambiguous.
fn date(text: &str) -> Option<Option<i64>> {
    let fields: Vec<&str> = text.split(['-', '/', '.']).collect();
    let [a, b, c] = fields[..] else { return None };
    let separator = text.as_bytes().get(a.len()).copied()?;
    let number = |field: &str| field.parse::<u32>().ok().filter(|_| field.len() <= 4);
    let is_month = |field: &str| field.len() == 3 && field.bytes().all(|b| b.is_ascii_alphabetic());
    if is_month(b) {
        return (number(a).is_some() && number(c).is_some()).then_some(None);
    }
    let (year, month, day) = match (a.len(), separator, c.len()) {
        (4, ..) => (number(a)?, number(b)?, number(c)?),
        (1 | 2, b'.', 4) => (number(c)?, number(b)?, number(a)?),
        (1 | 2, b'/' | b'-', 2 | 4) => {
            let is_ambiguous = number(a)?.max(number(b)?) <= 31 && number(c).is_some();
            return is_ambiguous.then_some(None);
        }
        _ => return None,
    };
    let days = NaiveDate::from_ymd_opt(i32::try_from(year).ok()?, month, day)?
        .signed_duration_since(NaiveDate::default())
        .num_days();
    days.checked_mul(DAY).map(Some)
}

/// Time of day since midnight, ns: UTC where a zone is given, else local.
fn time(text: &str) -> Option<i64> {
    let (text, noon) = match text
        .len()
        .checked_sub(2)
        .map(|at| (&text[..at], text[at..].to_ascii_uppercase()))
    {
        Some((clock, half)) if half == "PM" => (clock.trim_end(), Some(12)),
        Some((clock, half)) if half == "AM" => (clock.trim_end(), Some(0)),
        _ => (text, None),
    };
    let (text, offset) = zone(text)?;
    let fields: Vec<&str> = text.split(':').collect();
    let integer = |field: &str| {
        field
            .parse::<i64>()
            .ok()
            .filter(|_| (1..=4).contains(&field.len()) && field.bytes().all(|b| b.is_ascii_digit()))
    };
    let (hours, minutes, seconds) = match fields[..] {
        [hours, minutes, seconds] => (integer(hours)?, integer(minutes)?, fraction(seconds)?),
        [hours, minutes, seconds, thousandths] if thousandths.len() == 3 => (
            integer(hours)?,
            integer(minutes)?,
            fraction(&format!("{seconds}.{thousandths}"))?,
        ),
        // Without a fraction `14:07` may be hours and minutes.
        [minutes, seconds] if seconds.contains(['.', ',']) => {
            (0, integer(minutes)?, fraction(seconds)?)
        }
        _ => return None,
    };
    let hours = noon.map_or(hours, |noon| hours % 12 + noon);
    (minutes < 60).then_some((hours * 3600 + minutes * 60) * SECOND + seconds - offset)
}

/// Text before a time zone, and the offset of the zone from UTC, ns.
fn zone(text: &str) -> Option<(&str, i64)> {
    if let Some(without_zone) = text.strip_suffix(['Z', 'z']) {
        return Some((without_zone, 0));
    }
    let Some(at) = text.find(['+', '-']) else {
        return Some((text, 0));
    };
    let digits: String = text[at + 1..].chars().filter(|c| *c != ':').collect();
    let all = digits.len() == 4 && digits.bytes().all(|b| b.is_ascii_digit());
    let [hours, minutes] =
        [digits.get(..2)?, digits.get(2..)?].map(|field| field.parse::<i64>().ok());
    let offset = (hours.filter(|_| all)? * 3600 + minutes? * 60) * SECOND;
    Some((
        text[..at].trim_end(),
        if text[at..].starts_with('-') {
            -offset
        } else {
            offset
        },
    ))
}

/// Parses seconds below 61 with a fraction of any length; returns ns.
fn fraction(text: &str) -> Option<i64> {
    let (integer_digits, fraction_digits) = text.split_once(['.', ',']).unwrap_or((text, ""));
    let is_digits = |field: &str| field.bytes().all(|b| b.is_ascii_digit());
    if !(1..=2).contains(&integer_digits.len())
        || !is_digits(integer_digits)
        || !is_digits(fraction_digits)
    {
        return None;
    }
    let padded = format!("{fraction_digits:0<9}");
    let seconds = integer_digits
        .parse::<i64>()
        .ok()
        .filter(|seconds| *seconds < 61)?;
    Some(seconds * SECOND + padded.get(..9)?.parse::<i64>().ok()?)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn moments_of_every_spelling_are_read_and_nothing_else() {
        let at = |dated, nanoseconds| Some(Moment { nanoseconds, dated });
        let clock = (14 * 3600 + 7 * 60 + 1) * SECOND + 250_000_000;
        let day = 19_787 * DAY;
        let dated = [
            "2024-03-05T14:07:01.25",
            "2024-03-05 14:07:01,25",
            "2024/03/05 14:07:01.250000",
            "2024-03-05T14:07:01.25Z",
            "2024-03-05T15:07:01.25+01:00",
            "2024-03-05T09:07:01.25-0500",
            "05.03.2024 14:07:01.25",
            "5.3.2024 14:07:01:250",
        ];
        for text in dated {
            assert_eq!(Moment::read(text), at(true, day + clock), "{text}");
        }
        for text in [
            "14:07:01.25",
            "03/05/2024 2:07:01.25 PM",
            "05-Mar-2024 14:07:01.25",
            "14:07:01:250",
            "03/05/24 14:07:01.25",
        ] {
            assert_eq!(Moment::read(text), at(false, clock), "{text}");
        }
        assert_eq!(
            Moment::read("2024-03-05T15:07:01.25+01:00")
                .unwrap()
                .to_string(),
            "2024-03-05 14:07:01.25"
        );
        assert_eq!(
            Moment::read("07:01.25"),
            at(false, 421 * SECOND + 250_000_000)
        );
        assert_eq!(Moment::read("12:00:00 AM"), at(false, 0));
        assert_eq!(Moment::read("2024-03-05"), at(true, day));
        for text in [
            "",
            "12:00",
            "1.2.3",
            "1-2",
            "2024-13-05",
            "2024-02-30 1:02:03",
            "14:07:61.0",
            "14:77:01.0",
            "1:2:3:4:5",
            "5/6/7",
            "::",
            "9:9:9x",
            "1-2-3-4",
        ] {
            assert_eq!(Moment::read(text), None, "{text}");
        }
    }

    #[test]
    fn a_clock_passes_midnight_and_keeps_its_digits() {
        let read = |text: &str| Moment::read(text).unwrap();
        let mut clock = Clock::from(read("23:59:59.999"));
        assert_eq!(
            [
                clock.seconds(read("23:59:59.999")),
                clock.seconds(read("00:00:00.000")),
                clock.seconds(read("00:00:00.001"))
            ],
            [0.0, 0.001, 0.002]
        );
        let mut clock = Clock::from(read("2023-12-31T23:59:59.9"));
        assert_eq!(clock.seconds(read("2024-01-01T00:00:00.1")), 0.2);
    }
}
