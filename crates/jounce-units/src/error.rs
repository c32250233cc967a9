//! Error of a text that is not a quantity of the expected kind.

/// Reason why a text is not a quantity of the expected kind; every message lists the units that
/// fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum QuantityError {
    /// The text does not start with a number.
    #[error("{text:?} does not start with a number; {expected}")]
    NotANumber {
        /// text that was read
        text: String,
        /// expected value
        expected: String,
    },
    /// The text is a number without a unit.
    #[error("{text} has no unit; {expected}")]
    NoUnit {
        /// text that was read
        text: String,
        /// expected value
        expected: String,
    },
    /// The symbol is not a unit.
    #[error("{text:?}: {unit:?} is not a known unit{near}; {expected}")]
    UnknownUnit {
        /// text that was read
        text: String,
        /// unknown symbol
        unit: String,
        /// the unit that is probably meant, in words, or empty
        near: String,
        /// expected value
        expected: String,
    },
    /// The unit cannot be parsed.
    #[error("{text:?} cannot be read as a number and a unit ({reason}); {expected}")]
    Malformed {
        /// text that was read
        text: String,
        /// syntax error of the unit
        reason: String,
        /// expected value
        expected: String,
    },
    /// The quantity has another kind.
    #[error("{text:?} is {kind}; {expected}")]
    WrongKind {
        /// text that was read
        text: String,
        /// measured kind
        kind: String,
        /// expected value
        expected: String,
    },
    /// The value is outside the range of a double.
    #[error("{text:?} is too large or too small for a number in {unit}")]
    NotRepresentable {
        /// text that was read
        text: String,
        /// SI unit
        unit: String,
    },
}
