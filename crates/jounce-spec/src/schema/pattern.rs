//! Pattern of a number followed by a unit, as a regular expression without look-around.

use jounce_units::UnitSymbols;

use crate::Quantity;
use crate::key::Range;

/// A decimal number.
const NUMBER: &str = r"(\d+\.?\d*|\.\d+)";
/// A decimal number with a digit other than 0.
const NONZERO: &str = r"(0*[1-9]\d*\.?\d*|0*\.0*[1-9]\d*)";
/// A unit with a product, a quotient, a power or parentheses; its kind is not checked.
const COMPOSITE: &str = r"[^\s\d.,+−-]*[/*^·⋅()⁻⁰¹²³⁴⁵⁶⁷⁸⁹].*|[^\s\d.,+−-]+\s+\S.*|\s1\s*/.*";
/// A unit of any kind.
const ANY_UNIT: &str = r"[^\s\d.,+−-].*|\s1\s*/.*";

/// Returns the pattern of a number within the signs of a range, followed by a unit. A unit without
/// operators must be a symbol of the quantity, if one is given.
pub(super) fn pattern(range: &Range, quantity: Option<Quantity>) -> String {
    let sign = if range.low < 0.0 { "[+−-]?" } else { r"\+?" };
    let includes_zero = range.low < 0.0 || (range.low == 0.0 && !range.open);
    let number = if includes_zero { NUMBER } else { NONZERO };
    let unit = match quantity.map(symbols) {
        Some(symbols) if symbols.is_empty() => COMPOSITE.to_owned(),
        Some(symbols) => format!(r"({symbols})\s*|{COMPOSITE}"),
        None => ANY_UNIT.to_owned(),
    };
    format!(r"^\s*{sign}{number}([eE][+−-]?\d+)?\s*({unit})$")
}

/// Returns the symbols of a quantity as alternatives, empty if it has none.
fn symbols(quantity: Quantity) -> String {
    let symbols = quantity.symbols();
    let mut alternatives = Vec::new();
    if !symbols.prefixed.is_empty() {
        let (letters, longer): (Vec<_>, Vec<_>) =
            UnitSymbols::prefixes().partition(|prefix| prefix.chars().count() == 1);
        let prefixes = format!("([{}]|{})?", letters.concat(), longer.join("|"));
        alternatives.push(match symbols.prefixed.as_slice() {
            [only] => format!("{prefixes}{only}"),
            several => format!("{prefixes}({})", several.join("|")),
        });
    }
    alternatives.extend(symbols.plain.iter().map(|symbol| (*symbol).to_owned()));
    alternatives.join("|")
}
