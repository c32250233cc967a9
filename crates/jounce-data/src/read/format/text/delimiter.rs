//! Delimiter of the fields of a line.

/// Delimiter of the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Delimiter {
    /// One character.
    Byte(u8),
    /// Any number of spaces.
    Blanks,
}

impl Delimiter {
    /// Splits a line into fields; quoted fields may contain the delimiter.
    pub(crate) fn fields(self, line: &str) -> Vec<String> {
        match self {
            Self::Blanks => line.split_whitespace().map(str::to_owned).collect(),
            // Quotes are rare; without them a plain split is equivalent and faster.
            Self::Byte(delimiter) if !line.contains('"') => line
                .split(char::from(delimiter))
                .map(str::to_owned)
                .collect(),
            Self::Byte(delimiter) => {
                let mut reader = csv::ReaderBuilder::new()
                    .delimiter(delimiter)
                    .has_headers(false)
                    .flexible(true)
                    .from_reader(line.as_bytes());
                reader
                    .records()
                    .next()
                    .and_then(Result::ok)
                    .map(|record| record.iter().map(str::to_owned).collect())
                    .unwrap_or_default()
            }
        }
    }
}
