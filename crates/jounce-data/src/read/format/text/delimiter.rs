//! Delimiter of the fields of a line.

use std::borrow::Cow;

/// Delimiter of the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Delimiter {
    /// One character.
    Byte(u8),
    /// Any number of spaces.
    Blanks,
}

impl Delimiter {
    /// Returns the fields of a line.
    pub(crate) fn fields(self, line: &str) -> Vec<String> {
        let mut fields = Vec::new();
        self.each_field(line, |field| fields.push(field.to_owned()));
        fields
    }

    /// Calls `take` with each field of a line. A field that begins with a quote ends at the next single
    /// quote: it may contain the delimiter, and a quote as two (RFC 4180).
    pub(crate) fn each_field(self, line: &str, mut take: impl FnMut(&str)) {
        let delimiter = match self {
            Self::Blanks => return line.split_whitespace().for_each(take),
            Self::Byte(delimiter) => char::from(delimiter),
        };
        // Without quotes a plain split is equivalent and faster.
        if !line.contains('"') {
            return line.split(delimiter).for_each(take);
        }
        let mut rest = Some(line);
        while let Some(text) = rest {
            let (quoted, after) = match text.strip_prefix('"') {
                Some(text) => unquoted(text),
                None => (Cow::Borrowed(""), text),
            };
            let (plain, next) = match after.split_once(delimiter) {
                Some((plain, next)) => (plain, Some(next)),
                None => (after, None),
            };
            match (quoted.is_empty(), plain.is_empty()) {
                (true, _) => take(plain),
                (_, true) => take(&quoted),
                _ => take(&(quoted + plain)),
            }
            rest = next;
        }
    }
}

/// Splits the text after a quote at the next single quote; two stand for one.
fn unquoted(text: &str) -> (Cow<'_, str>, &str) {
    let mut end = 0;
    loop {
        let Some(quote) = text[end..].find('"') else {
            return (single_quotes(text), "");
        };
        end += quote + 1;
        match text[end..].strip_prefix('"') {
            Some(_) => end += 1,
            None => return (single_quotes(&text[..end - 1]), &text[end..]),
        }
    }
}

fn single_quotes(text: &str) -> Cow<'_, str> {
    match text.contains('"') {
        true => Cow::Owned(text.replace("\"\"", "\"")),
        false => Cow::Borrowed(text),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// The fields of the crate `csv`, for every text of up to seven of these characters.
    #[test]
    fn quoted_fields_are_those_of_another_reader() {
        let characters = ['"', ',', '1', ' '];
        for length in 1..=7 {
            for number in 0..4_usize.pow(length) {
                let digit = |k: u32| characters[number / 4_usize.pow(k) % 4];
                let line: String = (0..length).map(digit).collect();
                let mut reader = csv::ReaderBuilder::new()
                    .has_headers(false)
                    .flexible(true)
                    .from_reader(line.as_bytes());
                let record = reader.records().next().unwrap().unwrap();
                let expected: Vec<&str> = record.iter().collect();
                assert_eq!(Delimiter::Byte(b',').fields(&line), expected, "{line:?}");
            }
        }
        assert_eq!(Delimiter::Blanks.fields(" 1  \"2 "), ["1", "\"2"]);
    }
}
