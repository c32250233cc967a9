//! Why a text is not a quantity of the wanted kind.

/// Why a text is not a quantity of the wanted kind; every message says which units fit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum QuantityError {
    /// No number at the front.
    #[error("{text:?} does not start with a number; {due}")]
    NotANumber {
        /// what was read
        text: String,
        /// what is due instead
        due: String,
    },
    /// A number alone.
    #[error("{text} has no unit; {due}")]
    NoUnit {
        /// what was read
        text: String,
        /// what is due instead
        due: String,
    },
    /// A symbol that is no unit.
    #[error("{text:?}: {unit:?} is no known unit; {due}")]
    UnknownUnit {
        /// what was read
        text: String,
        /// the unknown symbol
        unit: String,
        /// what is due instead
        due: String,
    },
    /// A unit that cannot be read.
    #[error("{text:?} cannot be read as a number and a unit ({why}); {due}")]
    Malformed {
        /// what was read
        text: String,
        /// what is wrong with it
        why: String,
        /// what is due instead
        due: String,
    },
    /// A quantity of another kind.
    #[error("{text:?} is {kind}; {due}")]
    WrongKind {
        /// what was read
        text: String,
        /// what it measures
        kind: String,
        /// what is due instead
        due: String,
    },
    /// A value beyond what a 64-bit float can hold.
    #[error("{text:?} is too large or too small for a number in {unit}")]
    NotRepresentable {
        /// what was read
        text: String,
        /// the SI unit
        unit: String,
    },
}
