//! Formatting of numbers.

use crate::escape;
use jounce_io::table::Values;

/// Returns one cell of a table as HTML, with `digits` significant digits for real numbers. NaN and
/// cells beyond the last row are a dash.
pub(super) fn cell(values: &Values, row: usize, digits: usize) -> String {
    match values {
        Values::Float(v) => v.get(row).map_or_else(dash, |x| number(*x, digits)),
        Values::Flag(v) => v
            .get(row)
            .map_or_else(dash, |yes| if *yes { "yes" } else { "no" }.to_owned()),
        Values::Integer(v) => v
            .get(row)
            .map_or_else(dash, |x| x.to_string().replace('-', "−")),
        other => other.text(row).map_or_else(dash, |text| escape(&text)),
    }
}

fn dash() -> String {
    "–".to_owned()
}

/// Formats a real number with `digits` significant digits: as a decimal from 0.001 to 100000, else
/// with a power of ten.
pub(super) fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return if value.is_nan() {
            dash()
        } else {
            format!("{}∞", if value < 0.0 { "−" } else { "" })
        };
    }
    // The exponent follows from the rounded mantissa: 9.9996 with four digits is 10.00.
    let text = format!("{value:.*e}", digits.max(1) - 1);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    if value == 0.0 {
        return "0".to_owned();
    }
    if (-3..5).contains(&power) {
        let decimals = (digits as i32 - 1 - power).max(0) as usize;
        return format!("{value:.decimals$}").replace('-', "−");
    }
    format!(
        "{}×10<sup>{}</sup>",
        mantissa.replace('-', "−"),
        exponent.replace('-', "−")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (960.5178, "960.5"),
            (8.669_057, "8.669"),
            (9.999_96, "10.00"),
            (-0.001_25, "−0.001250"),
            (12_345.6, "12346"),
            (7.023_747e-5, "7.024×10<sup>−5</sup>"),
            (-1.5e10, "−1.500×10<sup>10</sup>"),
            (f64::NAN, "–"),
            (f64::NEG_INFINITY, "−∞"),
        ];
        for (value, expected) in cases {
            assert_eq!(number(value, 4), expected);
        }
        assert_eq!(number(5e-324, 1), "5×10<sup>−324</sup>");
    }
}
