//! Quantities as text: `"315 mm"`, `"1000 N/m^1.5"`, `"-170 pC/N"`.
//!
//! A quantity is a decimal number and a unit expression. The expression is a product of powers of
//! unit symbols,
//!
//! ```text
//! unit = prod_k symbol_k^p_k = factor * kg^a m^b s^c A^d rad^e
//! ```
//!
//! and the value in SI is number times factor. If the factor is a power of ten (all SI prefixes),
//! it is added to the decimal exponent of the number before conversion to binary, so `"0.98 mm"` is
//! the `f64` nearest to 0.98e-3.
//!
//! Here the angle is a dimension, so `rad/s` is never read as `Hz`.
//!
//! Source: The International System of Units (BIPM, 9th edition), tables 2, 4, 7 and 8.

mod clip;
mod decimal;
mod dimension;
mod error;
mod expression;
mod facts;
mod printed;
mod quantity;
mod symbol;
mod unit_symbols;

pub use clip::clip;
pub use decimal::Decimal;
pub use error::QuantityError;
pub use quantity::{Quantity, is_unit};
pub use symbol::STANDARD_GRAVITY_M_S2;
pub use unit_symbols::UnitSymbols;
