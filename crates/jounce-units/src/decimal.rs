//! Decimal numbers that remain exact until conversion to `f64`.

/// `digits * 10^exponent`, with the digits as written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decimal<'t> {
    negative: bool,
    digits: &'t str,
    exponent: i64,
}

impl<'t> Decimal<'t> {
    /// Splits a number off the front of a text: `"0.98 mm"` to 0.98 and `" mm"`. `None` if the text
    /// does not start with a number.
    pub fn split(text: &'t str) -> Option<(Self, &'t str)> {
        let (negative, unsigned) = match text.strip_prefix(['-', '\u{2212}']) {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let end = digits_end(unsigned)?;
        let (digits, mut rest) = unsigned.split_at(end);
        let mut exponent = 0;
        if let Some((value, after)) = exponent_of(rest) {
            exponent = value;
            rest = after;
        }
        Some((
            Self {
                negative,
                digits,
                exponent,
            },
            rest,
        ))
    }

    /// Returns the `f64` nearest to the number times `10^power`; infinite if it does not fit.
    pub fn scaled(self, power: i64) -> f64 {
        let text = format!("{}e{}", self.digits, self.exponent.saturating_add(power));
        let value = text.parse::<f64>().unwrap_or(f64::INFINITY);
        if self.negative { -value } else { value }
    }

    /// Returns the number times `10^power` as integer digits and a power of ten, if the digits fit.
    pub fn integer_ratio(self, power: i64) -> Option<(i128, i64)> {
        let decimals = self
            .digits
            .split_once('.')
            .map_or(0, |(_, after)| after.len());
        let digits = self.digits.replace('.', "").parse::<i128>().ok()?;
        let exponent = self.exponent.saturating_add(power) - i64::try_from(decimals).ok()?;
        Some((if self.negative { -digits } else { digits }, exponent))
    }

    /// True when every digit is 0.
    pub fn is_zero(self) -> bool {
        self.digits.chars().all(|c| c == '0' || c == '.')
    }
}

fn digits_end(text: &str) -> Option<usize> {
    let mut point = false;
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || (c == '.' && !std::mem::replace(&mut point, true))))
        .unwrap_or(text.len());
    text[..end]
        .contains(|c: char| c.is_ascii_digit())
        .then_some(end)
}

/// Returns an exponent at the front of a text: `e3` is one, the `E` of `Em` is not.
fn exponent_of(text: &str) -> Option<(i64, &str)> {
    let after = text.strip_prefix(['e', 'E'])?;
    let (negative, unsigned) = match after.strip_prefix(['-', '\u{2212}']) {
        Some(rest) => (true, rest),
        None => (false, after.strip_prefix('+').unwrap_or(after)),
    };
    let end = unsigned
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(unsigned.len());
    let (digits, rest) = unsigned.split_at(end);
    if digits.is_empty() {
        return None;
    }
    // Exponent beyond which every number is zero or infinite; the sum of two exponents still fits.
    let value = digits.parse::<i64>().unwrap_or(i64::MAX).min(1_000_000_000);
    Some((if negative { -value } else { value }, rest))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn number_prefix_is_split_from_rest() {
        for (text, value, rest) in [
            ("0.98 mm", 0.98, " mm"),
            ("13Hz", 13.0, "Hz"),
            ("1e3N", 1e3, "N"),
            ("1Em", 1.0, "Em"),
            ("-1.5e-3", -1.5e-3, ""),
            ("\u{2212}2 m", -2.0, " m"),
            ("+.5", 0.5, ""),
            ("1.2.3", 1.2, ".3"),
        ] {
            let (number, after) = Decimal::split(text).unwrap();
            assert_eq!((number.scaled(0), after), (value, rest), "{text}");
        }
        for text in ["", "-", ".", "mm", "e3", "+-1", "nan", "inf"] {
            assert!(Decimal::split(text).is_none(), "{text}");
        }
    }

    #[test]
    fn scaling_is_exact() {
        let (number, _) = Decimal::split("0.98").unwrap();
        assert_eq!(number.scaled(-3).to_bits(), 0.98e-3_f64.to_bits());
        let (number, _) = Decimal::split("1e99999999999999999999").unwrap();
        assert_eq!(number.scaled(-3), f64::INFINITY);
    }
}
