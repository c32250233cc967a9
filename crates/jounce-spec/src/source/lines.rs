//! Conversion of offsets to lines and columns.

/// Offsets at which the lines of a text begin.
pub(crate) struct Lines<'t> {
    text: &'t str,
    starts: Vec<usize>,
}

impl<'t> Lines<'t> {
    /// Finds the lines of a text.
    pub(crate) fn new(text: &'t str) -> Self {
        let breaks = text
            .bytes()
            .enumerate()
            .filter(|(_, byte)| *byte == b'\n')
            .map(|(offset, _)| offset + 1);
        Self {
            text,
            starts: std::iter::once(0).chain(breaks).collect(),
        }
    }

    /// Returns line and column, both from 1, the column in characters; an offset past the end
    /// counts as the end.
    pub(crate) fn line_and_column(&self, offset: usize) -> (usize, usize) {
        let offset = boundary(self.text, offset);
        let line = self.starts.partition_point(|start| *start <= offset);
        let start = self.starts[line - 1];
        (line, 1 + self.text[start..offset].chars().count())
    }

    /// Returns the range of the line that contains an offset, without its line break.
    pub(crate) fn range(&self, offset: usize) -> std::ops::Range<usize> {
        let line = self.starts.partition_point(|start| *start <= offset);
        let end = self
            .starts
            .get(line)
            .map_or(self.text.len(), |next| next - 1);
        self.starts[line - 1]..end
    }
}

/// Returns the last start of a character at or before an offset.
pub(super) fn boundary(text: &str, offset: usize) -> usize {
    (0..=offset.min(text.len()))
        .rev()
        .find(|at| text.is_char_boundary(*at))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_from_one_in_characters() {
        let lines = Lines::new("a\n\u{b5}m x\n");
        assert_eq!(lines.line_and_column(0), (1, 1));
        assert_eq!(lines.line_and_column(1), (1, 2));
        assert_eq!(lines.line_and_column(2), (2, 1));
        assert_eq!(lines.line_and_column(3), (2, 1));
        assert_eq!(lines.line_and_column(6), (2, 4));
        assert_eq!(lines.line_and_column(999), (3, 1));
        assert_eq!(Lines::new("").line_and_column(0), (1, 1));
        assert_eq!(lines.range(1), 0..1);
        assert_eq!(lines.range(4), 2..7);
    }
}
