//! Text in round brackets after a name: a unit, or a part of the name.

/// Words for a location, direction, channel or processing, in lower case. In round brackets they
/// are part of the name.
const REMARK_WORDS: [&str; 62] = [
    "x",
    "y",
    "z",
    "left",
    "right",
    "top",
    "bottom",
    "upper",
    "lower",
    "up",
    "down",
    "front",
    "rear",
    "back",
    "inner",
    "outer",
    "inside",
    "outside",
    "middle",
    "mid",
    "center",
    "centre",
    "tip",
    "root",
    "base",
    "end",
    "free",
    "fixed",
    "near",
    "far",
    "horizontal",
    "vertical",
    "axial",
    "radial",
    "tangential",
    "lateral",
    "north",
    "south",
    "east",
    "west",
    "table",
    "shaker",
    "hammer",
    "beam",
    "mass",
    "sensor",
    "channel",
    "input",
    "output",
    "reference",
    "raw",
    "filtered",
    "mean",
    "average",
    "rms",
    "peak",
    "max",
    "measured",
    "simulated",
    "calibrated",
    "corrected",
    "total",
];

/// Items labelled by a letter, in lower case: `sensor (A)`, `channel 2 (B)`.
const LABELLED_WORDS: [&str; 22] = [
    "sensor", "channel", "chan", "ch", "probe", "point", "position", "pos", "place", "location",
    "node", "input", "output", "signal", "gauge", "side", "line", "port", "module", "station",
    "site", "dof",
];

/// Functions that take an argument in round brackets, in lower case.
const FUNCTION_NAMES: [&str; 14] = [
    "re",
    "im",
    "real",
    "imag",
    "abs",
    "mag",
    "magnitude",
    "phase",
    "angle",
    "arg",
    "log",
    "log10",
    "sqrt",
    "diff",
];

/// Single letters that are units of quantities not found in recordings.
pub(super) const AMBIGUOUS_LETTERS: [char; 11] = [
    'A', 'C', 'F', 'H', 'J', 'K', 'S', 'T', 'W', '\u{3a9}', '\u{2126}',
];

/// True where round brackets after a name contain an unknown unit: a formula of units, or one word
/// that is not a location, direction, channel or argument. Numbers, words that end in one (`ch1`),
/// phrases, and single letters that are not units are names.
pub(super) fn may_be_unit(name: &str, unit_text: &str) -> bool {
    let function = name
        .rsplit(|c: char| !c.is_alphanumeric())
        .next()
        .unwrap_or_default()
        .to_lowercase();
    let is_remark = |word: &str| REMARK_WORDS.contains(&word.to_lowercase().as_str());
    let is_number = unit_text
        .chars()
        .all(|c| c.is_ascii_digit() || c.is_whitespace() || "+-.,:/*".contains(c));
    if is_number
        || FUNCTION_NAMES.contains(&function.as_str())
        || unit_text
            .split(|c: char| !c.is_alphanumeric())
            .any(is_remark)
    {
        return false;
    }
    if unit_text.contains([
        '/', '^', '%', '\u{b0}', '\u{b7}', '\u{22c5}', '\u{207b}', '\u{b2}', '\u{b3}',
    ]) {
        return true;
    }
    let is_single = unit_text.chars().count() == 1;
    let word = unit_text.chars().all(char::is_alphabetic);
    word && (!is_single || !is_labelled(name) && unit_text.contains(AMBIGUOUS_LETTERS))
}

/// True for a name with an item that letters label.
pub(super) fn is_labelled(name: &str) -> bool {
    name.split(|c: char| !c.is_alphabetic())
        .any(|word| LABELLED_WORDS.contains(&word.to_lowercase().as_str()))
}

/// Text before a bracket that closes at the end, and its contents, including nested brackets.
pub(super) fn bracketed(head: &str, open: char, close: char) -> Option<(&str, &str)> {
    let unit_text = head.strip_suffix(close)?;
    let mut depth = 0;
    let is_open = |(_, c): &(usize, char)| {
        depth += i32::from(*c == close) - i32::from(*c == open);
        depth < 0
    };
    let (at, _) = unit_text.char_indices().rev().find(is_open)?;
    Some((
        unit_text[..at].trim(),
        unit_text[at + open.len_utf8()..].trim(),
    ))
}
