//! Kind of the value of a key.

use crate::Quantity;

/// Kind of the value of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// `"NUMBER UNIT"`.
    Quantity(Quantity),
    /// A plain number.
    Number,
    /// A plain number, or `"NUMBER UNIT"`.
    NumberOr(Quantity),
    /// A whole number.
    Count,
    /// A list of plain numbers, each within the key's range.
    Numbers,
    /// A list of `"NUMBER UNIT"`, each within the key's range.
    Quantities(Quantity),
    /// One of these words.
    Choice(&'static [&'static str]),
    /// One of these words, or the path of a file, which has a dot or a slash in it.
    ChoiceOrPath(&'static [&'static str]),
    /// The path of a file.
    Path,
    /// Any text.
    Text,
    /// The name of another element; `what` names it in the docs.
    Reference {
        /// kind of the element, `"a beam"`
        what: &'static str,
    },
    /// The names of other elements.
    References {
        /// kind of the elements, `"patches"`
        what: &'static str,
    },
    /// A table of quantities under names chosen by the user.
    NamedQuantities(Quantity),
    /// A table of lists of numbers under names chosen by the user.
    NamedNumbers,
    /// A table of elements under names chosen by the user.
    Things,
    /// A table of keys.
    Table,
}

impl Kind {
    /// True for a number or a list of numbers.
    pub(crate) fn is_numeric(self) -> bool {
        matches!(
            self,
            Self::Quantity(_)
                | Self::Number
                | Self::NumberOr(_)
                | Self::Count
                | Self::Numbers
                | Self::Quantities(_)
                | Self::NamedQuantities(_)
                | Self::NamedNumbers
        )
    }

    /// True for a table.
    pub(crate) fn is_table(self) -> bool {
        matches!(
            self,
            Self::NamedQuantities(_) | Self::NamedNumbers | Self::Things | Self::Table
        )
    }

    /// Returns what a value without a number is: `"a name"`.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Self::Choice(_) | Self::Reference { .. } => "a name",
            Self::ChoiceOrPath(_) => "a name or the path of a file",
            Self::References { .. } => "a list of names",
            Self::Path => "the path of a file",
            Self::Text => "a text",
            Self::Things | Self::Table => "a table",
            _ => "a number",
        }
    }

    /// Returns the expected value for a message: `"expected a plain number"`.
    pub(crate) fn expectation(self) -> String {
        match self {
            Self::Quantity(quantity) | Self::NamedQuantities(quantity) => {
                format!(
                    "expected {} in quotes with a unit: {}",
                    quantity.kind(),
                    quantity.units().join(", ")
                )
            }
            Self::Number => "expected a plain number without quotes or unit".to_owned(),
            Self::NumberOr(quantity) => format!(
                "expected a plain number without quotes, or {} in quotes with a unit: {}",
                quantity.kind(),
                quantity.units().join(", ")
            ),
            Self::Quantities(quantity) => format!(
                "expected a list of texts, each {} with a unit ({}), such as [\"1 {unit}\", \"2 {unit}\"]",
                quantity.kind(),
                quantity.units().join(", "),
                unit = quantity.units()[0]
            ),
            Self::Count => "expected a whole number without quotes".to_owned(),
            Self::Numbers | Self::NamedNumbers => {
                "expected a list of plain numbers such as [0.01, 0.02]".to_owned()
            }
            Self::Choice(words) => format!("expected one of {}", quoted(words)),
            Self::ChoiceOrPath(words) => format!(
                "expected one of {}, or the path of a file such as \"./NAME\"",
                quoted(words)
            ),
            Self::Path => "expected the path of a file, in quotes".to_owned(),
            Self::Text => "expected a text in quotes".to_owned(),
            Self::Reference { what: noun } => format!("expected the name of {noun}, in quotes"),
            Self::References { what: noun } => {
                format!("expected a list of names of {noun} such as [\"one\", \"-other\"]")
            }
            Self::Things | Self::Table => "expected a table".to_owned(),
        }
    }

    /// Returns the kind of one number of a list.
    pub(crate) fn of_one(self) -> Self {
        match self {
            Self::Quantities(quantity) => Self::Quantity(quantity),
            _ => Self::Number,
        }
    }

    /// True for a list of numbers.
    pub(crate) fn is_list_of_numbers(self) -> bool {
        matches!(self, Self::Numbers | Self::Quantities(_))
    }

    /// Returns a number of this kind with its unit.
    pub(crate) fn show(self, value: f64) -> String {
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
