//! Numbers of universal files: fixed columns without separators, `1.0-2.0E+00-3.0E+00`, and
//! Fortran's `D`.

/// Reads the numbers of a line; `Err` contains a word that is not a number.
pub(super) fn numbers(line: &str, into: &mut Vec<f64>) -> Result<(), String> {
    for word in line.split_whitespace() {
        let mut remaining = word;
        while !remaining.is_empty() {
            let end = end_of_number(remaining);
            let (number, after_number) = remaining.split_at(end);
            let value = number
                .replace(['D', 'd'], "E")
                .parse::<f64>()
                .map_err(|_| number.to_owned())?;
            into.push(value);
            remaining = after_number;
        }
    }
    Ok(())
}

/// Finds the end of a number without separator: a sign that does not follow an exponent letter.
fn end_of_number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let starts_number = |k: &usize| {
        matches!(bytes[*k], b'+' | b'-') && !matches!(bytes[*k - 1], b'E' | b'e' | b'D' | b'd')
    };
    (1..bytes.len()).find(starts_number).unwrap_or(text.len())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::numbers;

    #[test]
    fn adjacent_numbers_are_separated() {
        let mut result = Vec::new();
        numbers(" 1.00000E+00-2.50000E-01 3.0D+02-4", &mut result).unwrap();
        assert_eq!(result, [1.0, -0.25, 300.0, -4.0]);
        assert_eq!(numbers("1.0 x", &mut result), Err("x".to_owned()));
        assert_eq!(numbers("--", &mut result), Err("-".to_owned()));
    }
}
