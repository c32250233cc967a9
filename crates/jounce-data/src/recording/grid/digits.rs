//! Resolution of printed stamps, determined from the numbers.

use std::fmt::Write as _;

use crate::recording::Series;

/// Roundoff of a stamp after reading, scaling and comparison, relative.
const DIGIT_ROUNDOFF: f64 = 8.0 * f64::EPSILON;
/// Digits of a double that survive a roundoff of a few units in its last place.
const MIN_SURE_DIGITS: usize = 15;
/// A number with at most so many digits was printed with them; further digits are roundoff.
const MAX_PRINTED_DIGITS: usize = 13;

/// Digits with which numbers were printed: decimal places or significant digits, whichever is
/// coarser for a number. They are found from the shortest decimal that reads back as the same
/// double.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Digits {
    decimals: i32,
    significant: i32,
}

impl Digits {
    /// Determines the digits of printed numbers, which may have been scaled by a power of ten.
    pub(crate) fn of<S: Series>(stamps: &S) -> Result<Self, S::Fault> {
        let mut digits = Self {
            decimals: 0,
            significant: 1,
        };
        let mut text = String::new();
        stamps.each(|x| {
            if let Some((count, exponent)) = printed(x, &mut text) {
                digits.significant = digits.significant.max(count);
                digits.decimals = digits.decimals.max(count - 1 - exponent);
            }
        })?;
        Ok(digits)
    }

    /// Maximum rounding error of a stamp: half a unit of its last digit.
    pub(crate) fn rounding(&self, stamp: f64) -> f64 {
        let magnitude = stamp.abs();
        let power = if magnitude > 0.0 {
            magnitude.log10().floor() as i32
        } else {
            -self.decimals
        };
        let last = (-self.decimals).max(power - self.significant + 1);
        0.5 * 10f64.powi(last) + DIGIT_ROUNDOFF * magnitude
    }
}

/// Number of printed digits, and the power of ten of the first one; `text` is a buffer.
fn printed(x: f64, text: &mut String) -> Option<(i32, i32)> {
    if !x.is_finite() {
        return None;
    }
    text.clear();
    write!(text, "{x:e}").ok()?;
    let mut result = significant_digits(text)?;
    if result.0 > MIN_SURE_DIGITS {
        text.clear();
        write!(text, "{x:.*e}", MIN_SURE_DIGITS - 1).ok()?;
        result = significant_digits(text)
            .filter(|(count, _)| *count <= MAX_PRINTED_DIGITS)
            .unwrap_or(result);
    }
    Some((result.0 as i32, result.1))
}

/// Digits before trailing zeros, and the exponent.
fn significant_digits(text: &str) -> Option<(usize, i32)> {
    let (mantissa, power) = text.split_once('e')?;
    let count = mantissa
        .trim_end_matches('0')
        .bytes()
        .filter(u8::is_ascii_digit)
        .count();
    Some((count.max(1), power.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_digits_are_found_in_either_notation() {
        let near = |result: f64, expected: f64| {
            assert!(
                (result / expected - 1.0).abs() < 1e-6,
                "{result} {expected}"
            )
        };
        let fixed: Vec<f64> = (0..2000)
            .map(|k| (f64::from(k) * 1e6 / 1536.0).round() / 1e6)
            .collect();
        let scaled: Vec<f64> = fixed.iter().map(|t| t * 1e-3).collect();
        let Ok(digits) = Digits::of(&fixed.as_slice());
        near(digits.rounding(1.0), 0.5e-6);
        near(digits.rounding(0.002), 0.5e-6);
        let Ok(digits) = Digits::of(&scaled.as_slice());
        near(digits.rounding(0.001), 0.5e-9);
        let scientific: Vec<f64> = (0..2000)
            .map(|k| {
                format!("{:.4e}", f64::from(k) / 1536.0)
                    .parse()
                    .unwrap_or(f64::NAN)
            })
            .collect();
        let Ok(digits) = Digits::of(&scientific.as_slice());
        near(digits.rounding(1.2), 0.5e-4);
        let full: Vec<f64> = (1..2000).map(|k| f64::from(k) / 1536.7).collect();
        let Ok(digits) = Digits::of(&full.as_slice());
        assert!(digits.rounding(1.0) < 1e-14);
    }
}
