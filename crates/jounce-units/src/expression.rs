//! Unit expressions: `N/m^1.5`, `N s/m`, `kg·m⁻³`, `1/(m s)`, `m^(3/2)`.
//!
//! ```text
//! unit   = factor { ( " " | "*" | "·" | "/" ) factor }
//! factor = ( symbol | "1" | "(" unit ")" ) [ power ]
//! power  = ( "^" | "**" ) number | superscript digits
//! ```
//!
//! A product after a quotient (`N/m s`) is ambiguous and is refused; parentheses resolve it.

use super::dimension::Dimension;
use super::quantity::MAX_CHARS;
use super::symbol::UnitSymbol;

/// Largest power of a unit.
const MAX_POWER: f64 = 12.0;

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// A unit in SI: `10^power_of_ten * up / down` of its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unit {
    pub(super) power_of_ten: f64,
    pub(super) up: f64,
    pub(super) down: f64,
    pub(super) dimension: Dimension,
}

/// Reason why an expression is not a unit.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum UnitFault {
    /// The symbol is unknown.
    Unknown(String),
    /// The text is not an expression; contains the reason.
    Malformed(String),
}

impl Unit {
    const ONE: Self = Self {
        power_of_ten: 0.0,
        up: 1.0,
        down: 1.0,
        dimension: Dimension::NONE,
    };

    /// Reads a complete expression.
    pub(super) fn parse(text: &str) -> Result<Self, UnitFault> {
        // The parser calls itself for each parenthesis.
        if text.chars().count() > MAX_CHARS {
            return Err(UnitFault::Malformed(format!(
                "longer than {MAX_CHARS} characters"
            )));
        }
        let mut parser = Parser { rest: text.trim() };
        let unit = parser.unit()?;
        if parser.rest.is_empty() {
            Ok(unit)
        } else {
            Err(parser.unexpected())
        }
    }

    fn times(self, other: Self, power: f64) -> Self {
        let (up, down) = if power < 0.0 {
            (other.down, other.up)
        } else {
            (other.up, other.down)
        };
        Self {
            power_of_ten: self.power_of_ten + other.power_of_ten * power,
            up: self.up * up.powf(power.abs()),
            down: self.down * down.powf(power.abs()),
            dimension: self.dimension.times(other.dimension, power),
        }
    }
}

struct Parser<'t> {
    rest: &'t str,
}

impl<'t> Parser<'t> {
    fn unit(&mut self) -> Result<Unit, UnitFault> {
        let mut unit = Unit::ONE;
        let mut divided = false;
        let mut first = true;
        loop {
            self.rest = self.rest.trim_start();
            if self.rest.is_empty() || self.rest.starts_with(')') {
                return if first {
                    Err(self.unexpected())
                } else {
                    Ok(unit)
                };
            }
            let divides = self.consume("/");
            let multiplies = !divides
                && !first
                && (self.consume("*") || self.consume("\u{b7}") || self.consume("\u{22c5}"));
            if !first && !divides && divided {
                return Err(UnitFault::Malformed(
                    "a product after a quotient is ambiguous; use parentheses, as in N/(m s)"
                        .to_owned(),
                ));
            }
            if divides || multiplies {
                self.rest = self.rest.trim_start();
            }
            unit = unit.times(self.factor()?, if divides { -1.0 } else { 1.0 });
            divided |= divides;
            first = false;
        }
    }

    fn factor(&mut self) -> Result<Unit, UnitFault> {
        let base = if self.consume("(") {
            let inner = self.unit()?;
            if !self.consume(")") {
                return Err(UnitFault::Malformed(
                    "a parenthesis is not closed".to_owned(),
                ));
            }
            inner
        } else if self.consume("1") {
            Unit::ONE
        } else {
            self.symbol()?
        };
        let power = self.power()?;
        if !power.is_finite() || power.abs() > MAX_POWER {
            return Err(UnitFault::Malformed(format!(
                "powers must be from -{MAX_POWER} to {MAX_POWER}"
            )));
        }
        Ok(Unit::ONE.times(base, power))
    }

    fn symbol(&mut self) -> Result<Unit, UnitFault> {
        let name = self.take(|c| c.is_alphabetic() || c == '\u{b0}' || c == '%');
        if name.is_empty() {
            return Err(self.unexpected());
        }
        let Some(unit) = UnitSymbol::find(name) else {
            return Err(UnitFault::Unknown(name.to_owned()));
        };
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(UnitFault::Malformed(format!(
                "write a power with ^, as in {name}^2"
            )));
        }
        Ok(Unit {
            power_of_ten: f64::from(unit.power_of_ten),
            up: unit.up,
            down: unit.down,
            dimension: unit.dimension,
        })
    }

    fn power(&mut self) -> Result<f64, UnitFault> {
        if self.consume("^") || self.consume("**") {
            if !self.consume("(") {
                return self.number();
            }
            let mut power = self.number()?;
            if self.consume("/") {
                power /= self.number()?;
            }
            return if self.consume(")") {
                Ok(power)
            } else {
                Err(UnitFault::Malformed(
                    "a parenthesis is not closed".to_owned(),
                ))
            };
        }
        let sign = if self.consume("⁻") { -1.0 } else { 1.0 };
        let digits = self.take(|c| SUPERSCRIPTS.contains(&c));
        if digits.is_empty() {
            return if sign > 0.0 {
                Ok(1.0)
            } else {
                Err(self.unexpected())
            };
        }
        let value = digits
            .chars()
            .filter_map(|c| SUPERSCRIPTS.iter().position(|s| *s == c));
        Ok(sign * value.fold(0.0, |sum, digit| 10.0 * sum + digit as f64))
    }

    fn number(&mut self) -> Result<f64, UnitFault> {
        let sign = if self.consume("-") || self.consume("\u{2212}") {
            -1.0
        } else {
            1.0
        };
        self.consume("+");
        let digits = self.take(|c| c.is_ascii_digit() || c == '.');
        digits
            .parse::<f64>()
            .map(|value| sign * value)
            .map_err(|_| UnitFault::Malformed("a power must be a number, as in m^1.5".to_owned()))
    }

    fn consume(&mut self, token: &str) -> bool {
        let stripped = self.rest.strip_prefix(token);
        self.rest = stripped.unwrap_or(self.rest);
        stripped.is_some()
    }

    fn take(&mut self, keep: impl Fn(char) -> bool) -> &'t str {
        let end = self.rest.find(|c| !keep(c)).unwrap_or(self.rest.len());
        let (token, rest) = self.rest.split_at(end);
        self.rest = rest;
        token
    }

    fn unexpected(&self) -> UnitFault {
        UnitFault::Malformed(match self.rest.chars().next() {
            Some(c) => format!("unexpected `{}`", c.escape_debug()),
            None => "the unit is incomplete".to_owned(),
        })
    }
}
