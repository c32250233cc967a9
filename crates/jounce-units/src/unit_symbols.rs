//! Symbols that are a unit of one kind of quantity without any operator.

use super::quantity::Quantity;
use super::symbol::{PREFIXES, UnitSymbol};

/// Symbols that are a unit of a quantity, without product, quotient or power.
#[derive(Debug, Clone, PartialEq)]
pub struct UnitSymbols {
    /// Symbols that take an SI prefix: `"m"` of a length.
    pub prefixed: Vec<&'static str>,
    /// Symbols that take no prefix: `"min"` of a time.
    pub plain: Vec<&'static str>,
}

impl UnitSymbols {
    /// SI prefixes as a unit may spell them.
    pub fn prefixes() -> impl Iterator<Item = &'static str> {
        PREFIXES.iter().map(|(prefix, _)| *prefix)
    }
}

impl Quantity {
    /// Returns the symbols that are a unit of this quantity.
    ///
    /// ```
    /// use jounce_units::Quantity;
    /// let time = Quantity::Time.symbols();
    /// assert_eq!((time.prefixed, time.plain), (vec!["s"], vec!["min", "h"]));
    /// ```
    pub fn symbols(self) -> UnitSymbols {
        let (prefixed, mut plain) = UnitSymbol::of_dimension(self.dimension());
        if self == Self::Acceleration {
            plain.push("g");
        }
        UnitSymbols { prefixed, plain }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUANTITIES: [Quantity; 9] = [
        Quantity::Length,
        Quantity::Mass,
        Quantity::Time,
        Quantity::Frequency,
        Quantity::Resistance,
        Quantity::Acceleration,
        Quantity::Angle,
        Quantity::Stiffness,
        Quantity::Strain,
    ];

    #[test]
    fn a_symbol_reads_as_its_quantity_and_as_no_other() {
        for quantity in QUANTITIES {
            let symbols = quantity.symbols();
            let names = symbols
                .prefixed
                .iter()
                .flat_map(|name| {
                    UnitSymbols::prefixes().map(move |prefix| format!("{prefix}{name}"))
                })
                .chain(symbols.prefixed.iter().map(|name| (*name).to_owned()))
                .chain(symbols.plain.iter().map(|name| (*name).to_owned()));
            for name in names {
                // `min` is the minute, not 10^-3 of an `in`; a prefix never hides another symbol of
                // the same kind.
                let text = format!("1 {name}");
                for other in QUANTITIES {
                    let is_gravity = name == "g" && other != quantity;
                    let reads = other.read(&text).is_ok();
                    assert!(
                        reads == (other == quantity) || is_gravity,
                        "{text}: {other:?}"
                    );
                }
            }
        }
        assert_eq!(Quantity::Stiffness.symbols().prefixed, Vec::<&str>::new());
    }
}
