//! Spellings of units in files.

/// Words for unit symbols, in lower case.
const UNIT_SPELLINGS: [(&str, &str); 16] = [
    ("volts", "V"),
    ("volt", "V"),
    ("newton", "N"),
    ("newtons", "N"),
    ("seconds", "s"),
    ("second", "s"),
    ("milliseconds", "ms"),
    ("microseconds", "us"),
    ("sec", "s"),
    ("hertz", "Hz"),
    ("pascal", "Pa"),
    ("g", "g"),
    ("gs", "g"),
    ("g's", "g"),
    ("m/s/s", "m/s^2"),
    ("m/sec^2", "m/s^2"),
];

/// Superscript characters and their meaning.
const SUPERSCRIPTS: [(char, char); 5] = [
    ('\u{207b}', '-'),
    ('\u{b9}', '1'),
    ('\u{b2}', '2'),
    ('\u{b3}', '3'),
    ('\u{2074}', '4'),
];

/// Bytes above which a text is no unit, and its brackets remain.
const MAX_UNIT_BYTES: usize = 1 << 10;

/// Removes brackets around the complete text.
pub(crate) fn unbracketed(text: &str) -> &str {
    let mut trimmed = text.trim();
    if trimmed.len() > MAX_UNIT_BYTES {
        return trimmed;
    }
    while let Some(inner) = without_brackets(trimmed) {
        trimmed = inner.trim();
    }
    trimmed
}

/// Removes one pair of brackets around the complete text; `None` without one.
fn without_brackets(text: &str) -> Option<&str> {
    [('[', ']'), ('(', ')')].iter().find_map(|(open, close)| {
        let inner = text.strip_prefix(*open)?.strip_suffix(*close)?;
        // In `(m/s)/(N)` the first bracket closes before the end.
        let mut depth = 0;
        let closes = |c: char| {
            depth += i32::from(c == *open) - i32::from(c == *close);
            depth < 0
        };
        (!inner.chars().any(closes)).then_some(inner)
    })
}

/// Removes brackets around the text and superscripts.
pub(super) fn normalised_spelling(text: &str) -> String {
    let mut normalised = plain_powers(unbracketed(text))
        .replace("**", "^")
        .replace(['\u{b7}', '\u{22c5}'], " ");
    if let Some((_, symbol)) = UNIT_SPELLINGS
        .iter()
        .find(|(word, _)| *word == normalised.to_lowercase())
    {
        return (*symbol).to_owned();
    }
    for (spelling, replacement) in [
        ("/s/s", "/s^2"),
        ("/sec/sec", "/s^2"),
        ("s2", "s^2"),
        ("s-2", "s^-2"),
    ] {
        if normalised.ends_with(spelling) {
            normalised.truncate(normalised.len() - spelling.len());
            normalised.push_str(replacement);
            break;
        }
    }
    normalised
}

/// Writes superscripts with `^` and digits: `s^-2` for `s⁻²`.
fn plain_powers(text: &str) -> String {
    let (mut normalised, mut is_superscript) = (String::new(), false);
    for c in text.chars() {
        let digit = SUPERSCRIPTS
            .iter()
            .find(|(spelling, _)| *spelling == c)
            .map(|(_, digit)| *digit);
        if digit.is_some() && !is_superscript {
            normalised.push('^');
        }
        is_superscript = digit.is_some();
        normalised.push(digit.unwrap_or(c));
    }
    normalised
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_around_the_complete_text_are_removed() {
        let many = format!("{}V{}", "(".repeat(400), ")".repeat(400));
        assert_eq!([" [ (m/s) ] ", &many].map(unbracketed), ["m/s", "V"]);
        assert_eq!(unbracketed("(m/s)/(N)"), "(m/s)/(N)");
        let line = format!("{}V{}", "(".repeat(1 << 20), ")".repeat(1 << 20));
        assert_eq!(unbracketed(&line), line);
    }
}
