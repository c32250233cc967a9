//! What a key holds.

use crate::spec::Quantity;

/// What a key holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::spec) enum Kind {
    /// `"NUMBER UNIT"`.
    Quantity(Quantity),
    /// A plain number.
    Number,
    /// A whole number.
    Count,
    /// A list of plain numbers, each within the key's range.
    Numbers,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// One of these words, or the path of a file, which has a dot or a slash in it.
    ChoiceOrPath(&'static [&'static str]),
    /// The path of a file.
    Path,
    /// Any text.
    Text,
    /// The name of another thing; `what` names it in the docs.
    Reference {
        /// what kind of thing, `"a beam"`
        what: &'static str,
    },
    /// The names of other things.
    References {
        /// what kind of things, `"patches"`
        what: &'static str,
    },
    /// A table of quantities under the user's own names.
    NamedQuantities(Quantity),
    /// A table of lists of numbers under the user's own names.
    NamedNumbers,
    /// A table of things under the user's own names.
    Things,
    /// A table of keys.
    Table,
}

impl Kind {
    /// What is due, for a message: `"a plain number"`.
    pub(in crate::spec) fn due(self) -> String {
        match self {
            Self::Quantity(quantity) | Self::NamedQuantities(quantity) => {
                format!(
                    "{} is due as text with a unit, in {}",
                    quantity.kind(),
                    quantity.units().join(", ")
                )
            }
            Self::Number => "a plain number is due, without quotes and without unit".to_owned(),
            Self::Count => "a whole number is due, without quotes".to_owned(),
            Self::Numbers | Self::NamedNumbers => {
                "a list of plain numbers is due, as in [0.01, 0.02]".to_owned()
            }
            Self::Choice(words) => format!("one of {} is due", quoted(words)),
            Self::ChoiceOrPath(words) => format!(
                "one of {} is due, or the path of a file, as in \"./NAME\"",
                quoted(words)
            ),
            Self::Path => "the path of a file is due, in quotes".to_owned(),
            Self::Text => "a text is due, in quotes".to_owned(),
            Self::Reference { what } => format!("the name of {what} is due, in quotes"),
            Self::References { what } => {
                format!("a list of names of {what} is due, as in [\"one\", \"-other\"]")
            }
            Self::Things | Self::Table => "a table is due".to_owned(),
        }
    }

    /// A number of this kind with its unit.
    pub(in crate::spec) fn show(self, value: f64) -> String {
        match self {
            _ if value == 0.0 => "0".to_owned(),
            Self::Quantity(quantity) | Self::NamedQuantities(quantity) => quantity.write(value),
            _ if value.fract() == 0.0 && (value.abs() < 1e9 || self == Self::Count) => {
                format!("{value}")
            }
            _ => format!("{value:?}"),
        }
    }
}

fn quoted(words: &[&str]) -> String {
    words
        .iter()
        .map(|word| format!("\"{word}\""))
        .collect::<Vec<_>>()
        .join(", ")
}
