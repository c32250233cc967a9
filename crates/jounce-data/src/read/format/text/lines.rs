//! Splits a text into lines, for any line ending.

/// Line ending of a text: a carriage return if there is no line feed.
pub(in crate::read) fn line_end(head: &[u8]) -> u8 {
    if !head.contains(&b'\n') && head.contains(&b'\r') {
        b'\r'
    } else {
        b'\n'
    }
}

/// Lines of the beginning of a text; the last one only if the text ends with it.
pub(in crate::read) fn complete_lines(text: &str, end: u8, is_all: bool) -> Vec<&str> {
    let mut lines: Vec<&str> = text
        .split(char::from(end))
        .map(|line| line.trim_end_matches('\r'))
        .collect();
    if lines.last().is_some_and(|last| last.is_empty() || !is_all) {
        lines.pop();
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_every_kind_are_split_and_a_cut_one_is_left_out() {
        for text in ["a\nb\n", "a\r\nb\r\n", "a\rb\r", "a\nb"] {
            assert_eq!(
                complete_lines(text, line_end(text.as_bytes()), true),
                ["a", "b"],
                "{text:?}"
            );
        }
        assert_eq!(complete_lines("1,2\n3,", b'\n', false), ["1,2"]);
        assert_eq!(complete_lines("1,2\n", b'\n', false), ["1,2"]);
    }
}
